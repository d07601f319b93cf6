#pragma once
#include <cstdint>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/plant.hpp"
#include "host/twin/sim/profile.hpp"
#include "host/twin/sim/random.hpp"

/// A position servo: encoder, position loop, DC motor, gearbox, housing temperature. Before a step
/// it gives a line in the torque-speed plane, for any engine with an implicit velocity motor; the
/// caller passes back the new speed.
namespace verp::sim {

/// One physics step's drive: a line over the joint's new speed, hence stable at any stiffness and
/// inertia.
struct Drive {
  double standstill_n_m = 0;
  double slope_n_m_s = 0;  ///< never negative

  double torque_n_m(double rate_rad_s) const { return standstill_n_m - slope_n_m_s * rate_rad_s; }
  Drive& operator+=(const Drive& other) {
    standstill_n_m += other.standstill_n_m;
    slope_n_m_s += other.slope_n_m_s;
    return *this;
  }
};

/// Converts as the controller does: without zero error, not rounded.
double count_of(const model::Servo& servo, double angle_rad);
double angle_of(const model::Servo& servo, double count);

/// X-series datasheets and e-Manuals beyond Entity's facts, and estimates.
struct ServoConstants {
  double ambient_c = 25.0;
  /// Copper's temperature coefficient, IEC 60028.
  double copper_per_k = 0.00393;
  /// XM430 Current Limit register: 1193 units of 2.69 mA, 1.4 times the stall current at 12 V.
  /// Back-driven motors exceed stall torque up to this limit.
  double current_limit_stalls = 1.4;
  /// A stuck joint is a stiff line to where it stuck. At this speed it would carry its whole
  /// friction, and each step returns this part of its displacement.
  double hold_speed_rad_s = 1e-4;
  double hold_return = 0.2;
  double still_rad_s = 1e-3;  ///< a slower braked joint stands
  /// Stiff enough to hold stall torque within half a degree.
  double stop_stiffness_n_m = 500.0;
  double stop_damping_n_m_s = 1.0;
};

struct ServoNoise {
  bool encoder = true;
  double zero_error_rad = 0;  ///< encoder reading minus joint angle
};

class ServoModel {
 public:
  /// Throws std::invalid_argument with the joint's name if the facts cannot drive a motor.
  ServoModel(const model::Joint& joint, const ServoNoise& noise, Random encoder_random,
             double initial_rad, const ServoConstants& constants = {});

  /// Runs the firmware loop as often as it is due, then motor and gearbox. external_n_m: torque on
  /// the joint besides this servo; with the motor's it loads the gears.
  Drive drive(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s,
              double external_n_m, double supply_v, double step_s);
  /// Ends the step; rate_rad_s is the joint's new speed.
  void finish(double rate_rad_s, double step_s);

  /// Positive as counts increase.
  const ServoMeasurement& measurement() const { return measurement_; }
  /// Torque on the joint in the last step, joint sense.
  double torque_n_m() const { return torque_n_m_; }
  /// Share of stall torque; above 1 when back-driven.
  double torque_use() const { return torque_use_; }
  /// The duty was at its limit in the last step.
  bool saturated() const { return saturated_; }
  double supply_current_a() const { return supply_current_a_; }
  /// An encoder that lies, to the servo's own loop too.
  bool encoder_stuck = false;
  double encoder_off_count = 0;  ///< added to what it reads
  void heat_to(double temperature_c) { measurement_.temperature_c = temperature_c; }
  /// Those of the bearing, in addition to the servo's own.
  double joint_damping_n_m_s() const { return joint_.damping_n_m_s; }
  double joint_friction_n_m() const { return joint_.friction_n_m; }
  void set_joint_damping(double damping_n_m_s) { joint_.damping_n_m_s = damping_n_m_s; }
  void set_joint_friction(double friction_n_m);
  /// The profile as the joint's true angle.
  double profile_rad() const {
    return angle_of(joint_.servo, profile_.count()) - noise_.zero_error_rad;
  }

 private:
  void sample_encoder(double angle_rad);
  void follow_profile(const ServoSetpoint& setpoint);
  double position_loop(const ServoSetpoint& setpoint);
  double velocity_loop(const ServoSetpoint& setpoint);
  /// The duty at which the motor draws that current now.
  double duty_for(double current_a) const;
  double duty(const ServoSetpoint& setpoint);
  double mean_duty(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s,
                   double step_s);
  Drive motor_line(double supply_v) const;
  double friction_budget_n_m(double rate_rad_s, double motor_n_m, double external_n_m) const;
  bool engage(double rate_rad_s, double step_s);
  void meet(double angle_rad, double rate_rad_s);
  Drive friction_line(double angle_rad, double rate_rad_s, double rest_n_m, double budget_n_m,
                      double step_s);
  Drive joint_line(double angle_rad, double step_s) const;

  model::Joint joint_;
  ServoNoise noise_;
  ServoConstants constants_;
  Random random_;
  ServoMeasurement measurement_;
  double resistance_ohm_ = 0;

  bool was_on_ = false;
  double next_loop_s_ = 0;  ///< from the next step's start
  Profile profile_{0};
  double integral_ = 0;    ///< PWM units
  double last_error_ = 0;  ///< counts
  bool saturated_ = false;

  double duty_ = 0;         ///< joint sense, mean
  Drive motor_;             ///< the motor alone, in the last step
  double rotor_rad_s_ = 0;  ///< seen from the joint; free inside the play
  double play_rad_ = 0;     ///< motor side ahead, within +-backlash/2
  bool engaged_ = true;     ///< not inside the play
  int sliding_ = 0;         ///< sign of the motion; 0: stuck
  double stuck_rad_ = 0;    ///< where it stuck
  Drive friction_, gear_;   ///< last step; gear_: all through the gears
  Drive drive_;             ///< with end stops and bearing
  double friction_n_m_ = 0;
  double budget_n_m_ = 0;  ///< friction beyond one step
  double push_n_m_ = 0;    ///< gear torque with budgeted friction
  double torque_n_m_ = 0;
  double torque_use_ = 0;
  double supply_current_a_ = 0;
};

}  // namespace verp::sim
