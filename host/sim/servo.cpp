#include "host/sim/servo.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace verp::sim {
namespace {

constexpr double kFullPwm = 885.0;  ///< e-manual X-series, PWM Limit: 885 is 100 %
// e-manual X-series, Position PID Gain: what a register unit of each gain is worth in PWM units per
// count.
constexpr double kPerP = 1.0 / 128.0;
constexpr double kPerI = 1.0 / 65536.0;
constexpr double kPerD = 1.0 / 16.0;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void require(bool good, const model::Joint& joint, const char* what) {
  if (!good) throw std::invalid_argument("joint '" + joint.name + "': " + what);
}

}  // namespace

double count_of(const model::Servo& servo, double angle_rad) {
  return servo.offset_count +
         servo.direction * servo.counts_per_rev / (2 * std::numbers::pi) * angle_rad;
}

double angle_of(const model::Servo& servo, double count) {
  return (count - servo.offset_count) * servo.direction * 2 * std::numbers::pi /
         servo.counts_per_rev;
}

double Drive::torque_n_m(double rate_rad_s) const {
  return std::clamp(slope_n_m_s * (speed_rad_s - rate_rad_s), -limit_n_m, limit_n_m);
}

ServoModel::ServoModel(const model::Joint& joint, const ServoNoise& noise, Random encoder_random,
                       double initial_rad, const ServoConstants& constants)
    : joint_(joint), noise_(noise), constants_(constants), random_(encoder_random) {
  const model::Servo& servo = joint.servo;
  require(servo.stall_torque_n_m > 0, joint, "its servo needs a stall torque above 0");
  require(servo.no_load_speed_rad_s > 0, joint, "its servo needs a no-load speed above 0");
  require(servo.counts_per_rev > 0, joint, "its servo needs counts per revolution above 0");
  require(servo.backlash_rad >= 0, joint, "backlash is negative");
  resistance_ohm_ = servo.stall_current_a > 0 ? constants.nominal_v / servo.stall_current_a : 0;
  measurement_.temperature_c = constants.ambient_c;
  measurement_.voltage_v = constants.nominal_v;
  sample_encoder(initial_rad);
  goal_count_ = measurement_.position_count;
  profile_count_ = goal_count_;
}

void ServoModel::sample_encoder(double angle_rad) {
  double count = count_of(joint_.servo, angle_rad + noise_.zero_error_rad);
  if (noise_.encoder) {
    count += random_.normal() * constants_.encoder_noise_deg / 360.0 * joint_.servo.counts_per_rev;
  }
  measurement_.position_count = static_cast<std::int32_t>(std::lround(count));
}

void ServoModel::follow_profile(const ServoSetpoint& setpoint, double step_s) {
  const bool armed_now = setpoint.torque_on && !was_on_;
  if (armed_now) profile_count_ = measurement_.position_count;
  if (armed_now || setpoint.goal_count != goal_count_) {
    goal_count_ = setpoint.goal_count;
    const double duration_s = std::max(setpoint.profile_ms * 1e-3, step_s);
    profile_step_count_s_ = (goal_count_ - profile_count_) / duration_s;
  }
  const double move = profile_step_count_s_ * step_s;
  const double remaining = goal_count_ - profile_count_;
  profile_count_ = std::abs(move) >= std::abs(remaining) ? goal_count_ : profile_count_ + move;
}

double ServoModel::position_loop(const ServoSetpoint& setpoint, double step_s) {
  const double step_ms = step_s * 1e3;
  const double limit = std::min(static_cast<double>(setpoint.pwm_limit), kFullPwm);
  const double error = profile_count_ - measurement_.position_count;
  const double gain_i = setpoint.i_gain * kPerI;
  integral_ += gain_i * error * step_ms;
  integral_ = std::clamp(integral_, -limit, limit);
  const double change = was_on_ ? (error - last_error_) / step_ms : 0.0;
  last_error_ = error;
  const double pwm = setpoint.p_gain * kPerP * error + integral_ + setpoint.d_gain * kPerD * change;
  saturated_ = std::abs(pwm) >= limit;
  return std::clamp(pwm, -limit, limit) / kFullPwm;
}

bool ServoModel::engage(double rate_rad_s, double step_s) {
  const double half = joint_.servo.backlash_rad / 2;
  if (half <= 0) return true;
  // Inside the play the rotor has nothing to push: it turns at its no-load speed.
  const double wanted = play_rad_ + (motor_.speed_rad_s - rate_rad_s) * step_s;
  play_rad_ = std::clamp(wanted, -half, half);
  return std::abs(wanted) >= half;
}

void ServoModel::drive_motor(double rate_rad_s, double supply_v, double step_s) {
  const model::Servo& servo = joint_.servo;
  const double warm =
      1.0 + constants_.copper_per_k * (measurement_.temperature_c - constants_.ambient_c);
  motor_.speed_rad_s = duty_ * servo.no_load_speed_rad_s * supply_v / constants_.nominal_v;
  motor_.slope_n_m_s = servo.stall_torque_n_m / servo.no_load_speed_rad_s / warm;
  motor_.limit_n_m = constants_.current_limit_stalls * servo.stall_torque_n_m;
  if (!engage(rate_rad_s, step_s)) motor_.slope_n_m_s = 0;
}

Drive ServoModel::with_gearbox(double angle_rad, double rate_rad_s, double step_s) const {
  const double friction =
      joint_.friction_n_m / std::max(std::abs(rate_rad_s), constants_.friction_corner_rad_s);
  const double past_stop = angle_rad - std::clamp(angle_rad, joint_.lower_rad, joint_.upper_rad);
  double stop_slope = 0;
  double stop_torque = 0;  // at standstill
  if (past_stop != 0) {
    stop_slope = step_s * constants_.stop_stiffness_n_m + constants_.stop_damping_n_m_s;
    stop_torque = -constants_.stop_stiffness_n_m * past_stop;
  }
  Drive sum;
  sum.slope_n_m_s = motor_.slope_n_m_s + friction + joint_.damping_n_m_s + stop_slope;
  if (sum.slope_n_m_s > 0) {
    sum.speed_rad_s = (motor_.slope_n_m_s * motor_.speed_rad_s + stop_torque) / sum.slope_n_m_s;
  }
  const double motor_torque = motor_.slope_n_m_s * (motor_.speed_rad_s - rate_rad_s);
  const bool limiting = std::abs(motor_torque) > motor_.limit_n_m && past_stop == 0;
  sum.limit_n_m = limiting ? motor_.limit_n_m + joint_.friction_n_m : kInfinity;
  return sum;
}

Drive ServoModel::drive(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s,
                        double supply_v, double step_s) {
  sample_encoder(angle_rad);
  follow_profile(setpoint, step_s);
  measurement_.voltage_v = supply_v;
  motor_ = Drive{};
  saturated_ = false;
  if (setpoint.torque_on) {
    measurement_.duty = position_loop(setpoint, step_s);
    duty_ = measurement_.duty * joint_.servo.direction;
    drive_motor(rate_rad_s, supply_v, step_s);
  } else {
    measurement_.duty = duty_ = 0;
    integral_ = 0;
  }
  was_on_ = setpoint.torque_on;
  drive_ = with_gearbox(angle_rad, rate_rad_s, step_s);
  return drive_;
}

void ServoModel::finish(double rate_rad_s, double step_s) {
  const model::Servo& servo = joint_.servo;
  torque_n_m_ = drive_.torque_n_m(rate_rad_s);
  const double motor_torque = motor_.torque_n_m(rate_rad_s);
  torque_use_ = std::abs(motor_torque) / servo.stall_torque_n_m;
  const double current = motor_torque / servo.stall_torque_n_m * servo.stall_current_a;
  measurement_.current_a = current * servo.direction;
  measurement_.velocity_rad_s = rate_rad_s * servo.direction;
  // An H-bridge's balance of power; what a braking motor returns the other servos use up.
  supply_current_a_ = std::max(0.0, duty_ * current);
  const double heat_w = current * current * resistance_ohm_;
  const double loss_w =
      (measurement_.temperature_c - constants_.ambient_c) / constants_.thermal_resistance_k_w;
  measurement_.temperature_c += (heat_w - loss_w) / constants_.heat_capacity_j_k * step_s;
}

}  // namespace verp::sim
