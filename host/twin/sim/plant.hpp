#pragma once
#include <array>
#include <cstdint>

/// The border between virtual devices, which speak bytes (host/twin/bus), and the physics that
/// gives them something to say (host/twin/sim). Registers only: no struct passes to the controller
/// by this way.
namespace verp::sim {

/// What a servo's control table tells its motor control; counts and units of an X-series/MX(2.0)
/// control table.
enum class ServoMode : std::uint8_t { kPosition, kVelocity, kCurrent, kPwm };
/// As in Moving Status (123).
enum class ProfileKind : std::uint8_t { kStep, kRectangular, kTriangular, kTrapezoidal };

struct ServoSetpoint {
  bool torque_on = false;
  std::int32_t goal_count = 0;
  std::uint16_t p_gain = 800;  ///< register value; the loop uses p/128, duty 885 is full
  std::uint16_t i_gain = 0;    ///< i/65536
  std::uint16_t d_gain = 0;    ///< d/16
  std::uint16_t pwm_limit = 885;
  std::uint32_t profile_ms = 0;  ///< time-based profile: how long the way takes; 0: velocity-based
  double accelerate_ms = 0;      ///< of it, at either end; 0: a straight line
  double profile_count_s = 0;    ///< velocity-based profile: its top speed; 0: a step
  double accelerate_count_s2 = 0;  ///< and its acceleration, of velocity mode too; 0: at once
  ServoMode mode = ServoMode::kPosition;
  double goal_count_s = 0;               ///< velocity mode
  double goal_a = 0;                     ///< current mode
  double goal_pwm = 0;                   ///< PWM mode
  double current_limit_a = -1;           ///< position mode: no more than that; negative: any
  std::uint16_t velocity_p_gain = 100;   ///< the loop uses p/128, of 0.229 rev/min
  std::uint16_t velocity_i_gain = 1920;  ///< i/65536
};

struct ServoMeasurement {
  std::int32_t position_count = 0;  ///< with encoder noise and zero error, multi-turn
  double velocity_rad_s = 0;
  double duty = 0;  ///< -1..1
  double current_a = 0;
  double temperature_c = 25;
  double voltage_v = 12;
  double trajectory_count = 0;    ///< where the profile stands
  double trajectory_count_s = 0;  ///< and how fast it goes
  ProfileKind profile = ProfileKind::kStep;
  bool profile_ongoing = false;
};

/// What a servo gives at full duty while it stands, by its maker's figures; 0: not known. And the
/// supply it is made for: it tells an input voltage error outside 9.5 to 16 V if that is 12 V
/// (e-Manual, XM430-W210, as it comes out of the box), in proportion if it is another.
struct ServoRating {
  double torque_n_m = 0;
  double current_a = 0;
  double nominal_v = 12;

  double least_v() const { return nominal_v * 9.5 / 12; }
  double most_v() const { return nominal_v * 16 / 12; }
};

/// Raw counts as the IMU device reports them, IMU frame.
struct ImuMeasurement {
  std::array<std::int16_t, 3> gyro_count{};
  std::array<std::int16_t, 3> accel_count{};
};

/// One robot in a world. Joint indices are those of Entity and Params. Time is simulated, in
/// microseconds since the world began. A bus asks for a time by advance_to(); whether it alone
/// moves the world then, or others have to ask as well, it does not know.
class Plant {
 public:
  virtual ~Plant() = default;
  virtual std::uint64_t now_us() const = 0;
  /// Runs whole physics steps up to the last one that ends at or before time_us; never goes back.
  virtual void advance_to(std::uint64_t time_us) = 0;
  virtual ServoSetpoint& setpoint(int joint) = 0;
  virtual ServoMeasurement measure(int joint) = 0;
  virtual ServoRating rating(int) const { return {}; }
  virtual ImuMeasurement imu() = 0;
  /// Normal force counts of one foot's sensors: front-left, front-right, back-left, back-right.
  virtual std::array<std::uint16_t, 4> foot_counts(int foot) = 0;
};

}  // namespace verp::sim
