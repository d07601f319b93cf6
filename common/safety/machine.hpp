#pragma once
#include <cstdint>

#include "common/base/fields.hpp"

/// What the robot may do, as a table: (mode, conditions) -> mode. Pure. README.md of this folder
/// shows the same table, and a test walks it row by row.
namespace verp::safety {

enum class Mode : std::uint8_t {
  kRelaxed,  ///< torque off, goals follow the joints
  kRising,   ///< from the pose found to the stand
  kStanding,
  kWalking,
  kHolding,    ///< goals frozen, because a device went silent
  kSitting,    ///< down to the crouch in which torque may be released
  kFallen,     ///< limp until the operator asks to relax
  kStopped,    ///< e-stop: limp until released and the operator asks to relax
  kActing,     ///< plays an action
  kFalling,    ///< a fall is certain: into the pose that bears it, with little strength
  kGettingUp,  ///< from the floor to the stand, by an action
};
inline constexpr int kModes = 11;
inline constexpr const char* kModeNames[kModes] = {"relaxed", "rising",  "standing",  "walking",
                                                   "holding", "sitting", "fallen",    "stopped",
                                                   "acting",  "falling", "getting up"};

enum Condition : std::uint32_t {
  kAskRelax = 1 << 0,
  kAskStand = 1 << 1,  ///< also if the operator asks to walk
  kAskWalk = 1 << 2,
  kServosKnown = 1 << 3,  ///< every servo has reported recently
  kTimeUp = 1 << 4,       ///< rise, sitting down or fall has lasted its time, or the action is over
  kGaitOver = 1 << 5,     ///< the gait stands on both feet
  kCalibrated = 1 << 6,   ///< gyro bias known
  kFell = 1 << 7,
  kEmergency = 1 << 8,
  kStale = 1 << 9,           ///< a servo or the IMU was silent for stale_hold_s
  kLost = 1 << 10,           ///< the same for stale_release_s
  kOperatorQuiet = 1 << 11,  ///< no operator frame for command_hold_s
  kOperatorGone = 1 << 12,   ///< no operator frame for command_release_s
  kPowerBad = 1 << 13,       ///< kPowerFaults, now or still latched
  kJointBeyond = 1 << 14,    ///< limp, and a joint is further beyond its limits than kBeyond_rad
  kAskAction = 1 << 15,      ///< a request whose action has not been played yet
  kFallSeen = 1 << 16,       ///< a fall is certain, and the robot has a pose for it
  kAskGetUp = 1 << 17,       ///< it lies still, and has an action for the side it lies on
  kPushed =
      1 << 18,  ///< pushed further than ankles can balance: it has to step, or is still recovering
};

/// Latched until the operator relaxes the robot. The upper half only reports limits that took
/// effect.
enum Fault : std::uint32_t {
  kFaultFall = 1 << 0,
  kFaultEmergency = 1 << 1,
  kFaultServoSilent = 1 << 2,
  kFaultImuSilent = 1 << 3,
  kFaultOperatorQuiet = 1 << 4,
  kFaultTemperature = 1 << 5,
  kFaultVoltage = 1 << 6,
  kFaultServoError = 1 << 7,
  kFaultJointBeyond = 1 << 8,    ///< stand request refused: a joint is beyond its limits
  kNoteOverrun = 1 << 16,        ///< a tick ended after its deadline
  kNoteParameter = 1 << 17,      ///< a parameter write was out of range and ignored
  kNoteStrideLimited = 1 << 18,  ///< the requested velocity needs longer steps than allowed
  kNotePlanShortened =
      1 << 19,  ///< steps shortened: leg reach, ZMP near the sole's edge, or colliding soles
  kNotePlanRefused = 1 << 20,   ///< no step keeps the ZMP in the sole
  kNoteLegLimited = 1 << 21,    ///< a leg could not reach its target
  kNoteSpeedLimited = 1 << 22,  ///< a joint's goal was held to its velocity limit
};

/// Faults that load causes and rest hides: the robot's reaction must not end when the load does.
inline constexpr std::uint32_t kPowerFaults = kFaultTemperature | kFaultVoltage | kFaultServoError;

struct MachineState {
  std::uint32_t faults = 0;     ///< Fault bits
  std::int32_t in_mode_us = 0;  ///< time in this mode, saturating
  Mode mode = Mode::kRelaxed;
  std::uint8_t falling_ms = 0;  ///< how long the body has been beyond recovery, up to 255
  std::uint16_t way_ms = 0;     ///< duration of the last rise or sitting down
  VERP_FIELDS(faults, in_mode_us, mode, falling_ms, way_ms)
};
VERP_PACKED(MachineState);

struct Row {
  std::uint32_t from;     ///< bit mask of modes
  std::uint32_t all_of;   ///< conditions that must hold
  std::uint32_t none_of;  ///< conditions that must not
  Mode to;
};

/// The first matching row decides. Without one the mode stays.
extern const Row kTable[];
extern const int kRows;

Mode next_mode(Mode mode, std::uint32_t conditions);

constexpr bool has_torque(Mode mode) {
  return mode != Mode::kRelaxed && mode != Mode::kFallen && mode != Mode::kStopped;
}

}  // namespace verp::safety
