#pragma once
#include <cstdint>

#include "common/base/fields.hpp"

/// All data that crosses the controller's border: raw counts as on the wire (Params holds scales,
/// signs and ranges), without padding.
namespace verp {

inline constexpr int kMaxJoints = 32;  ///< fits a uint32_t bit mask
inline constexpr int kFeet = 2;        ///< index 0 is left, 1 is right, everywhere
inline constexpr int kFootSensors =
    4;  ///< front-left, front-right, back-left, back-right of each sole

enum InputFlag : std::uint16_t {
  kImuFresh = 1 << 0,        ///< gyro and accel read this tick
  kFeetFresh = 1 << 1,       ///< all foot sensors read this tick
  kSlowFresh = 1 << 2,       ///< slow telemetry of one servo read this tick
  kOverrun = 1 << 3,         ///< the previous tick ended after its deadline
  kEmergencyStop = 1 << 4,   ///< the e-stop input is pressed
  kCommandFresh = 1 << 5,    ///< an operator frame arrived this tick
  kParameterWrite = 1 << 6,  ///< parameter_id and parameter_bits are valid
  kImuAssumed = 1 << 7,      ///< there is no IMU: gyro and accel are those of an upright body
};

/// kWalk and kGetUp include kStand. Only kGetUp permits torque on the floor.
enum class Request : std::uint8_t { kRelax = 0, kStand = 1, kWalk = 2, kGetUp = 3 };

/// The operator's order; stands until the next one.
struct Command {
  Request request = Request::kRelax;
  std::uint8_t sequence = 0;        ///< counts operator frames, for the watchdog
  std::int16_t vx_tenth_mm_s = 0;   ///< forward, body frame, 0.1 mm/s
  std::int16_t vy_tenth_mm_s = 0;   ///< to the left, 0.1 mm/s
  std::int16_t wz_mrad_s = 0;       ///< turn to the left, mrad/s
  std::int16_t head_pan_mrad = 0;   ///< to the left
  std::int16_t head_tilt_mrad = 0;  ///< down
  VERP_FIELDS(request, sequence, vx_tenth_mm_s, vy_tenth_mm_s, wz_mrad_s, head_pan_mrad,
              head_tilt_mrad)
};
VERP_PACKED(Command);

/// Everything that can differ between two runs, for one tick.
struct Inputs {
  std::uint32_t tick = 0;            ///< the only clock: periods since power-up
  std::uint32_t fresh = 0;           ///< bit j: position_count[j] read this tick
  std::uint16_t flags = 0;           ///< InputFlag bits
  std::uint16_t parameter_id = 0;    ///< index into Tuning
  std::uint32_t parameter_bits = 0;  ///< float32 bits of the new value
  Command command;
  std::int16_t gyro_count[3] = {};   ///< IMU frame
  std::int16_t accel_count[3] = {};  ///< IMU frame, specific force
  std::uint16_t foot_count[kFeet][kFootSensors] = {};
  std::uint8_t slow_joint = 0;          ///< joint of the next three values
  std::uint8_t slow_temperature_c = 0;  ///< as MX/X servos report
  std::uint8_t slow_error = 0;          ///< hardware error status register
  std::uint8_t action = 0;              ///< requested action; 0: none
  std::uint16_t slow_voltage_tenth_v = 0;
  std::uint16_t mailbox = 0;  ///< free for boards: button bits
  std::int32_t position_count[kMaxJoints] = {};
  VERP_FIELDS(tick, fresh, flags, parameter_id, parameter_bits, command, gyro_count, accel_count,
              foot_count, slow_joint, slow_temperature_c, slow_error, action, slow_voltage_tenth_v,
              mailbox, position_count)
};
VERP_PACKED(Inputs);

struct Outputs {
  std::uint32_t torque_enable = 0;       ///< bit j: servo j holds its goal
  std::uint32_t faults = 0;              ///< safety::Fault bits, latched
  std::uint8_t mode = 0;                 ///< safety::Mode
  std::uint8_t gait_phase = 0;           ///< gait::Phase
  std::uint8_t gait_state = 0;           ///< 0..15, state in the cycle
  std::uint8_t stance = 0;               ///< stance foot (0 left, 1 right); 2: both
  std::int16_t tilt_tenth_mrad[2] = {};  ///< estimated roll and pitch of the body
  std::int32_t goal_count[kMaxJoints] = {};
  VERP_FIELDS(torque_enable, faults, mode, gait_phase, gait_state, stance, tilt_tenth_mrad,
              goal_count)
};
VERP_PACKED(Outputs);

}  // namespace verp
