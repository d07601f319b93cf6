#pragma once
#include <cstdint>

#include "common/base/fields.hpp"

/// What the robot is allowed to do, as a table: (mode, conditions) -> mode. Pure; README.md of this
/// folder shows the same table, and a test walks it row by row.
namespace verp::safety {

enum class Mode : std::uint8_t {
  kRelaxed,  ///< torque off, goals follow the joints
  kRising,   ///< from the pose found to the stand
  kStanding,
  kWalking,
  kHolding,    ///< something went silent: goals frozen
  kSitting,    ///< down to the crouch from which torque may go
  kFallen,     ///< limp until the operator asks to relax
  kStopped,    ///< e-stop: limp until released and asked to relax
  kActing,     ///< plays an action
  kFalling,    ///< the ground will be met: into the pose that bears it, with little strength
  kGettingUp,  ///< from the floor to the stand, by an action
};
inline constexpr int kModes = 11;
inline constexpr const char* kModeNames[kModes] = {"relaxed", "rising",  "standing",  "walking",
                                                   "holding", "sitting", "fallen",    "stopped",
                                                   "acting",  "falling", "getting up"};

enum Condition : std::uint32_t {
  kAskRelax = 1 << 0,
  kAskStand = 1 << 1,  ///< stand or walk
  kAskWalk = 1 << 2,
  kServosKnown = 1 << 3,  ///< every servo has reported recently
  kTimeUp = 1 << 4,      ///< the rise, sitting down or fall has lasted its time, the action is over
  kGaitOver = 1 << 5,    ///< the gait stands on both feet
  kCalibrated = 1 << 6,  ///< gyro bias known
  kFell = 1 << 7,
  kEmergency = 1 << 8,
  kStale = 1 << 9,           ///< a servo or the IMU silent for stale_hold_s
  kLost = 1 << 10,           ///< likewise for stale_release_s
  kOperatorQuiet = 1 << 11,  ///< no operator frame for command_hold_s
  kOperatorGone = 1 << 12,   ///< no operator frame for command_release_s
  kPowerBad = 1 << 13,       ///< kPowerFaults, now or still latched
  kJointBeyond = 1 << 14,    ///< limp, and a joint is further beyond its limits than kBeyond_rad
  kAskAction = 1 << 15,      ///< one that has not been played for this asking
  kFallSeen = 1 << 16,       ///< it will meet the ground, and has a pose for that
  kAskGetUp = 1 << 17,       ///< it has lain still, and has an action for the side on which it lies
  kPushed = 1 << 18,  ///< further than ankles answer to: it has to step, or is not over it yet
};

/// Latched until the operator relaxes the robot. The upper half reports what was limited; it stops
/// nothing.
enum Fault : std::uint32_t {
  kFaultFall = 1 << 0,
  kFaultEmergency = 1 << 1,
  kFaultServoSilent = 1 << 2,
  kFaultImuSilent = 1 << 3,
  kFaultOperatorQuiet = 1 << 4,
  kFaultTemperature = 1 << 5,
  kFaultVoltage = 1 << 6,
  kFaultServoError = 1 << 7,
  kFaultJointBeyond = 1 << 8,    ///< asked to stand with a joint beyond its limits: refused
  kNoteOverrun = 1 << 16,        ///< a tick ended after its deadline
  kNoteParameter = 1 << 17,      ///< a parameter write was out of range and ignored
  kNoteStrideLimited = 1 << 18,  ///< velocity asked needs longer steps than allowed
  kNotePlanShortened = 1 << 19,  ///< steps shortened: leg reach, ZMP near the sole's edge, or soles
                                 ///< in each other's way
  kNotePlanRefused = 1 << 20,    ///< no step keeps the ZMP in the sole
  kNoteLegLimited = 1 << 21,     ///< a leg could not reach its target
  kNoteSpeedLimited = 1 << 22,   ///< a joint's goal was held to its velocity limit
};

/// Trouble that load brings and rest hides: what it made the robot do must not end with the load.
inline constexpr std::uint32_t kPowerFaults = kFaultTemperature | kFaultVoltage | kFaultServoError;

struct MachineState {
  std::uint32_t faults = 0;     ///< Fault bits
  std::int32_t in_mode_us = 0;  ///< since the mode was entered, saturating
  Mode mode = Mode::kRelaxed;
  std::uint8_t falling_ms = 0;  ///< how long its body has been beyond return, up to 255
  std::uint16_t way_ms = 0;     ///< how long the last rise or sitting down takes
  VERP_FIELDS(faults, in_mode_us, mode, falling_ms, way_ms)
};
VERP_PACKED(MachineState);

struct Row {
  std::uint32_t from;     ///< bit mask of modes
  std::uint32_t all_of;   ///< conditions that must hold
  std::uint32_t none_of;  ///< conditions that must not
  Mode to;
};

/// First row that fits wins; none: the mode stays.
extern const Row kTable[];
extern const int kRows;

Mode next_mode(Mode mode, std::uint32_t conditions);

constexpr bool has_torque(Mode mode) {
  return mode != Mode::kRelaxed && mode != Mode::kFallen && mode != Mode::kStopped;
}

}  // namespace verp::safety
