#pragma once
#include <array>
#include <cstdint>

/// Interface between virtual devices (host/twin/bus), which speak bytes, and the physics. It
/// carries register values only.
namespace verp::sim {

/// In counts and units of an X-series/MX(2.0) control table.
enum class ServoMode : std::uint8_t { kPosition, kVelocity, kCurrent, kPwm };
/// As in Moving Status (123).
enum class ProfileKind : std::uint8_t { kStep, kRectangular, kTriangular, kTrapezoidal };

struct ServoSetpoint {
  bool torque_on = false;
  std::int32_t goal_count = 0;
  std::uint16_t p_gain = 800;  ///< the loop uses p/128; duty 885 is full
  std::uint16_t i_gain = 0;    ///< i/65536
  std::uint16_t d_gain = 0;    ///< d/16
  std::uint16_t pwm_limit = 885;
  std::uint32_t profile_ms = 0;    ///< time-based profile's duration; 0: velocity-based
  double accelerate_ms = 0;        ///< part of it at each end; 0: a straight line
  double profile_count_s = 0;      ///< velocity-based profile's top speed; 0: a step
  double accelerate_count_s2 = 0;  ///< also in velocity mode; 0: at once
  ServoMode mode = ServoMode::kPosition;
  double goal_count_s = 0;
  double goal_a = 0;
  double goal_pwm = 0;
  double current_limit_a = -1;           ///< in position mode; negative: none
  std::uint16_t velocity_p_gain = 100;   ///< the loop uses p/128, per 0.229 rev/min
  std::uint16_t velocity_i_gain = 1920;  ///< i/65536
};

struct ServoMeasurement {
  std::int32_t position_count = 0;  ///< multi-turn, with encoder noise and zero error
  double velocity_rad_s = 0;
  double duty = 0;  ///< -1..1
  double current_a = 0;
  double temperature_c = 25;
  double voltage_v = 12;
  double trajectory_count = 0;
  double trajectory_count_s = 0;
  ProfileKind profile = ProfileKind::kStep;
  bool profile_ongoing = false;
};

/// Stall values at full duty, from the maker; 0: unknown. Nominal supply: a 12 V servo accepts 9.5
/// to 16 V (e-Manual, XM430-W210); other servos' limits scale.
struct ServoRating {
  double torque_n_m = 0;
  double current_a = 0;
  double nominal_v = 12;

  double least_v() const { return nominal_v * 9.5 / 12; }
  double most_v() const { return nominal_v * 16 / 12; }
};

/// Raw counts, IMU frame.
struct ImuMeasurement {
  std::array<std::int16_t, 3> gyro_count{};
  std::array<std::int16_t, 3> accel_count{};
};

/// One robot in a world. Joints are indexed as in Entity and Params. Time is simulated microseconds
/// since the world began.
class Plant {
 public:
  virtual ~Plant() = default;
  virtual std::uint64_t now_us() const = 0;
  /// Runs the whole physics steps that end by time_us; never goes back.
  virtual void advance_to(std::uint64_t time_us) = 0;
  virtual ServoSetpoint& setpoint(int joint) = 0;
  virtual ServoMeasurement measure(int joint) = 0;
  virtual ServoRating rating(int) const { return {}; }
  virtual ImuMeasurement imu() = 0;
  /// Normal force counts of one foot: front-left, front-right, back-left, back-right.
  virtual std::array<std::uint16_t, 4> foot_counts(int foot) = 0;
};

}  // namespace verp::sim
