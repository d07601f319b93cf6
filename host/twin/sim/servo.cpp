#include "host/twin/sim/servo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace verp::sim {
namespace {

constexpr double kFullPwm = 885.0;  ///< e-Manual X-series, PWM Limit: 885 is 100 %
// e-Manual X-series, Position PID Gain: PWM units per count for one unit of each gain.
constexpr double kPerP = 1.0 / 128.0;
constexpr double kPerI = 1.0 / 65536.0;
constexpr double kPerD = 1.0 / 16.0;
constexpr double kVelocityUnit_rev_s = 0.229 / 60;  ///< e-Manual X-series, Velocity Limit

void require(bool good, const model::Joint& joint, const char* what) {
  if (!good) throw std::invalid_argument("joint '" + joint.name + "': " + what);
}

/// Models M3 and M4 of Rhoban's BAM; M5 where the sides count apart, M6 with its squares.
double load_friction_n_m(const model::Gearbox& gears, double motor_n_m, double external_n_m,
                         double stribeck) {
  if (!gears.is_directional)
    return std::abs(external_n_m - motor_n_m) * (gears.l_base + stribeck * gears.l_strib);
  const double base = std::abs(external_n_m * gears.l_external - motor_n_m * gears.l_base);
  const double still = std::abs(external_n_m * gears.l_external_strib - motor_n_m * gears.l_strib);
  double squares = 0;
  if (motor_n_m * external_n_m < 0) {
    const bool motor_wins = std::abs(external_n_m) < std::abs(motor_n_m);
    squares = motor_wins ? gears.q_external_per_n_m * external_n_m * external_n_m
                         : gears.q_motor_per_n_m * motor_n_m * motor_n_m;
  }
  return base + stribeck * (still + squares);
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

ServoModel::ServoModel(const model::Joint& joint, const ServoNoise& noise, Random encoder_random,
                       double initial_rad, const ServoConstants& constants)
    : joint_(joint), noise_(noise), constants_(constants), random_(encoder_random) {
  const model::Servo& servo = joint.servo;
  require(servo.stall_torque_n_m > 0, joint, "its servo needs a stall torque above 0");
  require(servo.no_load_speed_rad_s > 0, joint, "its servo needs a no-load speed above 0");
  require(servo.counts_per_rev > 0, joint, "its servo needs counts per revolution above 0");
  require(servo.nominal_v > 0, joint, "its servo needs a nominal supply above 0");
  require(servo.loop_s > 0, joint, "its servo's loop needs a period above 0");
  require(servo.backlash_rad >= 0, joint, "backlash is negative");
  require(servo.gearbox.armature_kg_m2 >= 0, joint, "its servo's armature is negative");
  require(servo.heat_capacity_j_k > 0 && servo.heat_resistance_k_w > 0, joint,
          "its servo's heat capacity or resistance is not above 0");
  require(servo.gearbox.w_s_rad_s > 0, joint, "its servo's Stribeck speed is not above 0");
  resistance_ohm_ = servo.stall_current_a > 0 ? servo.nominal_v / servo.stall_current_a : 0;
  measurement_.temperature_c = constants.ambient_c;
  measurement_.voltage_v = servo.nominal_v;
  stuck_rad_ = initial_rad;
  sample_encoder(initial_rad);
  profile_ = Profile(measurement_.position_count);
}

void ServoModel::sample_encoder(double angle_rad) {
  if (encoder_stuck) return;
  double count = count_of(joint_.servo, angle_rad + noise_.zero_error_rad) + encoder_off_count;
  if (noise_.encoder) {
    count +=
        random_.normal() * joint_.servo.encoder_noise_deg / 360.0 * joint_.servo.counts_per_rev;
  }
  measurement_.position_count = static_cast<std::int32_t>(std::lround(count));
}

void ServoModel::follow_profile(const ServoSetpoint& setpoint) {
  const double step_s = joint_.servo.loop_s;
  const bool armed_now = setpoint.torque_on && !was_on_;
  if (armed_now) profile_.stand(measurement_.position_count);
  if (setpoint.mode != ServoMode::kPosition) {
    const bool steers = setpoint.mode == ServoMode::kVelocity && setpoint.torque_on;
    const double goal = steers ? setpoint.goal_count_s : 0;
    profile_.stand(measurement_.position_count, steers ? profile_.count_s() : 0);
    profile_.follow_speed(goal, setpoint.accelerate_count_s2, step_s);
  } else {
    if (armed_now || setpoint.goal_count != profile_.goal_count()) profile_.begin(setpoint, step_s);
    profile_.advance(step_s);
  }
  measurement_.trajectory_count = profile_.count();
  measurement_.trajectory_count_s = profile_.count_s();
  measurement_.profile = profile_.kind();
  measurement_.profile_ongoing = profile_.ongoing();
}

double ServoModel::position_loop(const ServoSetpoint& setpoint) {
  const double step_ms = joint_.servo.loop_s * 1e3;
  const double limit = std::min(static_cast<double>(setpoint.pwm_limit), kFullPwm);
  const double error = profile_.count() - measurement_.position_count;
  const double gain_i = setpoint.i_gain * kPerI;
  integral_ += gain_i * error * step_ms;
  integral_ = std::clamp(integral_, -limit, limit);
  const double change = was_on_ ? (error - last_error_) / step_ms : 0.0;
  last_error_ = error;
  const double pwm = setpoint.p_gain * kPerP * error + integral_ + setpoint.d_gain * kPerD * change;
  saturated_ = std::abs(pwm) >= limit;
  return std::clamp(pwm, -limit, limit) / kFullPwm;
}

// Velocity PI Gain (76, 78). The error's unit is an estimate: it is not in the e-Manual.
double ServoModel::velocity_loop(const ServoSetpoint& setpoint) {
  const double step_ms = joint_.servo.loop_s * 1e3;
  const double limit = std::min(static_cast<double>(setpoint.pwm_limit), kFullPwm);
  const double per_unit = joint_.servo.counts_per_rev * kVelocityUnit_rev_s;
  const double rate_count_s =
      measurement_.velocity_rad_s * joint_.servo.counts_per_rev / (2 * std::numbers::pi);
  const double error = (profile_.count_s() - rate_count_s) / per_unit;
  integral_ += setpoint.velocity_i_gain * kPerI * error * step_ms;
  integral_ = std::clamp(integral_, -limit, limit);
  const double pwm = setpoint.velocity_p_gain * kPerP * error + integral_;
  saturated_ = std::abs(pwm) >= limit;
  return std::clamp(pwm, -limit, limit) / kFullPwm;
}

double ServoModel::duty_for(double current_a) const {
  const model::Servo& servo = joint_.servo;
  if (servo.stall_current_a <= 0) return std::copysign(1.0, current_a);
  const double warm =
      1.0 + constants_.copper_per_k * (measurement_.temperature_c - constants_.ambient_c);
  return (current_a / servo.stall_current_a * warm +
          measurement_.velocity_rad_s / servo.no_load_speed_rad_s) *
         servo.nominal_v / measurement_.voltage_v;
}

double ServoModel::duty(const ServoSetpoint& setpoint) {
  const double limit = std::min(static_cast<double>(setpoint.pwm_limit), kFullPwm) / kFullPwm;
  switch (setpoint.mode) {
    case ServoMode::kVelocity:
      return velocity_loop(setpoint);
    case ServoMode::kCurrent:
      return std::clamp(duty_for(setpoint.goal_a), -limit, limit);
    case ServoMode::kPwm:
      return std::clamp(setpoint.goal_pwm / kFullPwm, -limit, limit);
    case ServoMode::kPosition:
      break;
  }
  const double duty = position_loop(setpoint);
  if (setpoint.current_limit_a < 0) return duty;
  return std::clamp(duty, duty_for(-setpoint.current_limit_a), duty_for(setpoint.current_limit_a));
}

// The firmware loop runs at its own instants within physics steps. It uses the angle of
// loop_delay_s earlier, and its duty holds until the next run.
double ServoModel::mean_duty(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s,
                             double step_s) {
  constexpr double kSameInstant_s = 1e-9;
  const model::Servo& servo = joint_.servo;
  double sum_s = 0, until_s = 0;
  for (; next_loop_s_ < step_s - kSameInstant_s; next_loop_s_ += servo.loop_s) {
    sum_s += measurement_.duty * (next_loop_s_ - until_s);
    until_s = next_loop_s_;
    sample_encoder(angle_rad + rate_rad_s * (next_loop_s_ - servo.loop_delay_s));
    follow_profile(setpoint);
    saturated_ = false;
    if (setpoint.torque_on) {
      measurement_.duty = duty(setpoint);
    } else {
      measurement_.duty = integral_ = 0;
    }
    was_on_ = setpoint.torque_on;
  }
  next_loop_s_ -= step_s;
  return (sum_s + measurement_.duty * (step_s - until_s)) / step_s;
}

Drive ServoModel::motor_line(double supply_v) const {
  const model::Servo& servo = joint_.servo;
  const double warm =
      1.0 + constants_.copper_per_k * (measurement_.temperature_c - constants_.ambient_c);
  const Drive line{duty_ * servo.stall_torque_n_m * supply_v / servo.nominal_v / warm,
                   servo.stall_torque_n_m / servo.no_load_speed_rad_s / warm};
  const double limit = servo.peak_torque_n_m > 0
                           ? servo.peak_torque_n_m
                           : constants_.current_limit_stalls * servo.stall_torque_n_m;
  const double torque = line.torque_n_m(rotor_rad_s_);
  return std::abs(torque) > limit ? Drive{std::copysign(limit, torque), 0} : line;
}

/// New friction holds the joint at its present angle, not at an old one.
void ServoModel::set_joint_friction(double friction_n_m) {
  joint_.friction_n_m = friction_n_m;
  if (std::abs(rotor_rad_s_) > constants_.still_rad_s) sliding_ = rotor_rad_s_ > 0 ? 1 : -1;
}

double ServoModel::friction_budget_n_m(double rate_rad_s, double motor_n_m,
                                       double external_n_m) const {
  const model::Gearbox& gears = joint_.servo.gearbox;
  const double speed = std::abs(rate_rad_s);
  const double stribeck = std::exp(-std::pow(speed / gears.w_s_rad_s, gears.alpha));
  return joint_.friction_n_m + gears.f_base_n_m + stribeck * gears.f_strib_n_m +
         load_friction_n_m(gears, motor_n_m, external_n_m, stribeck) + gears.f_visc_n_m_s * speed;
}

// The rotor stays on a flank while that pushes. Inside the play only its own motion decides whether
// it reaches a flank.
bool ServoModel::engage(double rate_rad_s, double step_s) {
  const double half = joint_.servo.backlash_rad / 2;
  const double push = push_n_m_ * play_rad_;
  if (half <= 0 || (engaged_ && push > 0)) return true;
  const double inertia = joint_.servo.gearbox.armature_kg_m2 / step_s;
  const double drive = motor_.standstill_n_m + inertia * rotor_rad_s_;
  const double slope = motor_.slope_n_m_s + inertia;
  const double budget = friction_budget_n_m(rotor_rad_s_, motor_.torque_n_m(rotor_rad_s_), 0);
  const double rest = std::max(std::abs(drive) - budget, 0.0);
  const double alone_rad_s = slope > 0 ? std::copysign(rest, drive) / slope : rate_rad_s;
  const double wanted = play_rad_ + (alone_rad_s - rate_rad_s) * step_s;
  const bool pulls = engaged_ && push < 0;
  play_rad_ = std::clamp(wanted, -half, half);
  const bool meets = std::abs(wanted) >= half && !pulls;
  if (!meets) rotor_rad_s_ = alone_rad_s;
  return meets;
}

// Where they meet, rotor and joint move on in the joint's direction.
void ServoModel::meet(double angle_rad, double rate_rad_s) {
  const double speed = std::abs(rate_rad_s) > constants_.still_rad_s ? rate_rad_s : rotor_rad_s_;
  const bool still = std::abs(speed) <= constants_.still_rad_s;
  sliding_ = still ? 0 : speed > 0 ? 1 : -1;
  stuck_rad_ = angle_rad;
}

// Stuck: held until that exceeds the budget. Sliding: the budget opposes the motion. If it may end
// within this step, a line through standstill cannot reverse the motion. If other forces reversed
// the joint, it slides the other way without sticking.
Drive ServoModel::friction_line(double angle_rad, double rate_rad_s, double rest_n_m,
                                double budget_n_m, double step_s) {
  if (rate_rad_s * sliding_ < -constants_.still_rad_s) sliding_ = -sliding_;
  const bool wins = rest_n_m * sliding_ >= budget_n_m;
  const double along = rate_rad_s * sliding_;
  if (sliding_ != 0 && along <= (wins ? 0.0 : constants_.still_rad_s)) {
    sliding_ = 0;
    stuck_rad_ = angle_rad;
  } else if (sliding_ == 0 && std::abs(friction_n_m_) > budget_n_m) {
    sliding_ = friction_n_m_ > 0 ? -1 : 1;
    return {-budget_n_m * sliding_, 0};
  }
  if (sliding_ != 0) {
    const double speed = std::max(std::abs(rate_rad_s), constants_.still_rad_s);
    return wins ? Drive{-budget_n_m * sliding_, 0} : Drive{0, budget_n_m / speed};
  }
  const double slope = budget_n_m / constants_.hold_speed_rad_s;
  return {slope * constants_.hold_return * (stuck_rad_ - angle_rad) / step_s, slope};
}

Drive ServoModel::joint_line(double angle_rad, double step_s) const {
  Drive line{0, joint_.damping_n_m_s};
  const double past_stop = angle_rad - std::clamp(angle_rad, joint_.lower_rad, joint_.upper_rad);
  if (past_stop != 0) {
    line += {-constants_.stop_stiffness_n_m * past_stop,
             step_s * constants_.stop_stiffness_n_m + constants_.stop_damping_n_m_s};
  }
  return line;
}

Drive ServoModel::drive(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s,
                        double external_n_m, double supply_v, double step_s) {
  duty_ = mean_duty(setpoint, angle_rad, rate_rad_s, step_s) * joint_.servo.direction;
  measurement_.voltage_v = supply_v;
  if (engaged_) rotor_rad_s_ = rate_rad_s;
  motor_ = setpoint.torque_on ? motor_line(supply_v) : Drive{};
  const bool was_engaged = engaged_;
  engaged_ = engage(rate_rad_s, step_s);
  if (engaged_ && !was_engaged) meet(angle_rad, rate_rad_s);
  gear_ = friction_ = Drive{};
  if (engaged_) {
    const double inertia = joint_.servo.gearbox.armature_kg_m2 / step_s;
    const double rest = motor_.standstill_n_m + external_n_m + inertia * rate_rad_s;
    budget_n_m_ = friction_budget_n_m(rate_rad_s, motor_.torque_n_m(rate_rad_s), external_n_m);
    friction_ = friction_line(angle_rad, rate_rad_s, rest, budget_n_m_, step_s);
    gear_ = motor_;
    gear_ += {inertia * rotor_rad_s_, inertia};
    gear_ += friction_;
  }
  drive_ = gear_;
  drive_ += joint_line(angle_rad, step_s);
  return drive_;
}

void ServoModel::finish(double rate_rad_s, double step_s) {
  const model::Servo& servo = joint_.servo;
  if (engaged_) rotor_rad_s_ = rate_rad_s;
  torque_n_m_ = drive_.torque_n_m(rate_rad_s);
  friction_n_m_ = friction_.torque_n_m(rate_rad_s);
  // Friction that stops a rotor takes all the torque it needs for one step; this does not pull the
  // rotor off a flank.
  push_n_m_ = gear_.torque_n_m(rate_rad_s) - friction_n_m_ +
              std::clamp(friction_n_m_, -budget_n_m_, budget_n_m_);
  const double motor_torque = motor_.torque_n_m(rotor_rad_s_);
  torque_use_ = std::abs(motor_torque) / servo.stall_torque_n_m;
  const double current = motor_torque / servo.stall_torque_n_m * servo.stall_current_a;
  measurement_.current_a = current * servo.direction;
  measurement_.velocity_rad_s = rate_rad_s * servo.direction;
  // Power balance of an H-bridge; other servos use the current of a braking motor.
  supply_current_a_ = std::max(0.0, duty_ * current);
  const double heat_w = current * current * resistance_ohm_;
  const double loss_w =
      (measurement_.temperature_c - constants_.ambient_c) / servo.heat_resistance_k_w;
  measurement_.temperature_c += (heat_w - loss_w) / servo.heat_capacity_j_k * step_s;
}

}  // namespace verp::sim
