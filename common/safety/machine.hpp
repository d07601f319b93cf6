#pragma once
#include <cstdint>

#include "common/base/fields.hpp"

/// (mode, conditions) -> mode, as a table. host/guide/safety.md shows it; a test walks it row by
/// row.
namespace verp::safety {

enum class Mode : std::uint8_t {
  kRelaxed,  ///< torque off, goals follow the joints
  kRising,   ///< from the pose found to the stand
  kStanding,
  kWalking,
  kHolding,  ///< a device went silent: goals frozen
  kSitting,  ///< into the crouch
  kFallen,   ///< limp until a relax request
  kStopped,  ///< e-stop: limp until released and relaxed
  kActing,
  kFalling,    ///< certain to fall: with little strength into a pose that bears it
  kGettingUp,  ///< from the floor to the stand, by an action
  kLyingDown,  ///< from the crouch to the floor, by an action
};
inline constexpr int kModes = 12;
inline constexpr const char* kModeNames[kModes] = {
    "relaxed", "rising",  "standing", "walking", "holding",    "sitting",
    "fallen",  "stopped", "acting",   "falling", "getting up", "lying down"};

enum Condition : std::uint32_t {
  kAskRelax = 1 << 0,
  kAskStand = 1 << 1,  ///< the operator asks to stand or walk
  kAskWalk = 1 << 2,
  kServosKnown = 1 << 3,  ///< every servo has reported recently
  kTimeUp = 1 << 4,       ///< rise, sitting, fall or action is over
  kGaitOver = 1 << 5,     ///< the gait stands on both feet
  kCalibrated = 1 << 6,   ///< gyro bias known
  kFell = 1 << 7,
  kEmergency = 1 << 8,
  kStale = 1 << 9,           ///< servo or IMU silent for stale_hold_s
  kLost = 1 << 10,           ///< the same for stale_release_s
  kOperatorQuiet = 1 << 11,  ///< no operator frame for command_hold_s
  kOperatorGone = 1 << 12,   ///< no operator frame for command_release_s
  kTrouble = 1 << 13,        ///< kTroubleFaults, now or still latched
  kJointBeyond = 1 << 14,    ///< limp, and a joint is over kBeyond_rad beyond its limits
  kAskAction = 1 << 15,      ///< the operator asks for an action not yet played
  kFallSeen = 1 << 16,       ///< certain to fall, and has a pose for it
  kAskGetUp = 1 << 17,       ///< lies still, and has an action for this side
  kPushed = 1 << 18,         ///< pushed beyond what ankles balance: has to step
  kLiesDown = 1 << 19,       ///< has an action that lies down
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
  kFaultJointBeyond = 1 << 8,    ///< stand refused: a joint is beyond its limits
  kFaultFlutter = 1 << 9,        ///< silent again and again
  kFaultNotFollowing = 1 << 10,  ///< a joint is stuck, or not where its goals led it
  kFaultUnloaded = 1 << 11,      ///< the feet carry nothing
  kNoteOverrun = 1 << 16,        ///< a tick ended after its deadline
  kNoteParameter = 1 << 17,      ///< a parameter write was out of range and ignored
  kNoteStrideLimited = 1 << 18,  ///< the velocity needs longer steps than allowed
  kNotePlanShortened = 1 << 19,  ///< steps shortened: reach, ZMP near the edge, or soles collide
  kNotePlanRefused = 1 << 20,    ///< no step keeps the ZMP in the sole
  kNoteLegLimited = 1 << 21,     ///< a leg could not reach its target
  kNoteSpeedLimited = 1 << 22,   ///< a joint hit its velocity limit
};

/// Rest hides their cause, a load or a motion: the reaction must outlast it.
inline constexpr std::uint32_t kTroubleFaults = kFaultTemperature | kFaultVoltage |
                                                kFaultServoError | kFaultFlutter |
                                                kFaultNotFollowing | kFaultUnloaded;

/// Each silence that holds the robot adds kForgotten_us, which time takes away: three in ten
/// seconds, a cable that is touched, never add up. Over kFlutter_us is flutter: five at once.
inline constexpr std::int32_t kForgotten_us = 3'000'000;
inline constexpr std::int32_t kFlutter_us = 4 * kForgotten_us;

struct MachineState {
  std::uint32_t faults = 0;     ///< Fault bits
  std::int32_t in_mode_us = 0;  ///< time in this mode, saturating
  Mode mode = Mode::kRelaxed;
  std::uint8_t falling_ms = 0;  ///< time beyond recovery, up to 255
  std::uint16_t way_ms = 0;     ///< duration of the last rise or sitting
  std::int32_t flutter_us = 0;  ///< of silences that held the robot
  std::uint32_t silent = 0;     ///< bit j: servo j's silence held it last; 0: another device's
  VERP_FIELDS(faults, in_mode_us, mode, falling_ms, way_ms, flutter_us, silent)
};
VERP_PACKED(MachineState);

struct Row {
  std::uint32_t from;     ///< bit mask of modes
  std::uint32_t all_of;   ///< conditions that must hold
  std::uint32_t none_of;  ///< conditions that must not hold
  Mode to;
};

/// The first matching row decides; otherwise the mode stays.
extern const Row kTable[];
extern const int kRows;

Mode next_mode(Mode mode, std::uint32_t conditions);

constexpr bool has_torque(Mode mode) {
  return mode != Mode::kRelaxed && mode != Mode::kFallen && mode != Mode::kStopped;
}

}  // namespace verp::safety
