#pragma once
#include <cstdint>

#include "common/base/fields.hpp"

/// (mode, conditions) -> mode, as a table. host/guide/safety.md shows it; a test walks it row by
/// row.
namespace verp::safety {

enum class Mode : std::uint8_t {
  kRelaxed,  ///< torque off, goals follow the joints
  kRising,   ///< to the stand
  kStanding,
  kWalking,
  kHolding,  ///< a device went silent: goals frozen
  kSitting,  ///< into the crouch that needs no torque
  kFallen,   ///< limp until a relax request
  kStopped,  ///< e-stop: limp until released and relaxed
  kActing,
  kFalling,    ///< into a pose that bears the fall
  kGettingUp,  ///< by an action
};
inline constexpr int kModes = 11;
inline constexpr const char* kModeNames[kModes] = {"relaxed", "rising",  "standing",  "walking",
                                                   "holding", "sitting", "fallen",    "stopped",
                                                   "acting",  "falling", "getting up"};

enum Condition : std::uint32_t {
  kAskRelax = 1 << 0,
  kAskStand = 1 << 1,  ///< or to walk
  kAskWalk = 1 << 2,
  kServosKnown = 1 << 3,  ///< all reported recently
  kTimeUp = 1 << 4,       ///< rise, sitting, fall or action
  kGaitOver = 1 << 5,     ///< on both feet
  kCalibrated = 1 << 6,   ///< gyro bias known
  kFell = 1 << 7,
  kEmergency = 1 << 8,
  kStale = 1 << 9,           ///< servo or IMU, for stale_hold_s
  kLost = 1 << 10,           ///< for stale_release_s
  kOperatorQuiet = 1 << 11,  ///< for command_hold_s
  kOperatorGone = 1 << 12,   ///< for command_release_s
  kPowerBad = 1 << 13,       ///< kPowerFaults, now or latched
  kJointBeyond = 1 << 14,    ///< limp, joint over kBeyond_rad
  kAskAction = 1 << 15,      ///< not yet played
  kFallSeen = 1 << 16,       ///< and has a pose for it
  kAskGetUp = 1 << 17,       ///< lies still, action for this side
  kPushed = 1 << 18,         ///< beyond what ankles balance
};

/// Latched until the operator relaxes the robot. The upper half only reports.
enum Fault : std::uint32_t {
  kFaultFall = 1 << 0,
  kFaultEmergency = 1 << 1,
  kFaultServoSilent = 1 << 2,
  kFaultImuSilent = 1 << 3,
  kFaultOperatorQuiet = 1 << 4,
  kFaultTemperature = 1 << 5,
  kFaultVoltage = 1 << 6,
  kFaultServoError = 1 << 7,
  kFaultJointBeyond = 1 << 8,    ///< stand refused
  kNoteOverrun = 1 << 16,        ///< a tick was late
  kNoteParameter = 1 << 17,      ///< a parameter write was out of range
  kNoteStrideLimited = 1 << 18,  ///< velocity needs longer steps
  kNotePlanShortened = 1 << 19,  ///< reach, ZMP near the sole's edge, or soles collide
  kNotePlanRefused = 1 << 20,    ///< no step keeps the ZMP in the sole
  kNoteLegLimited = 1 << 21,
  kNoteSpeedLimited = 1 << 22,
};

/// Load causes these and rest hides them: the reaction must outlast the load.
inline constexpr std::uint32_t kPowerFaults = kFaultTemperature | kFaultVoltage | kFaultServoError;

struct MachineState {
  std::uint32_t faults = 0;     ///< Fault bits
  std::int32_t in_mode_us = 0;  ///< saturating
  Mode mode = Mode::kRelaxed;
  std::uint8_t falling_ms = 0;  ///< beyond recovery, up to 255
  std::uint16_t way_ms = 0;     ///< last rise or sitting
  VERP_FIELDS(faults, in_mode_us, mode, falling_ms, way_ms)
};
VERP_PACKED(MachineState);

struct Row {
  std::uint32_t from;     ///< mask of modes
  std::uint32_t all_of;   ///< conditions
  std::uint32_t none_of;  ///< conditions
  Mode to;
};

/// The first match decides; else the mode stays.
extern const Row kTable[];
extern const int kRows;

Mode next_mode(Mode mode, std::uint32_t conditions);

constexpr bool has_torque(Mode mode) {
  return mode != Mode::kRelaxed && mode != Mode::kFallen && mode != Mode::kStopped;
}

}  // namespace verp::safety
