#pragma once
#include <cstdint>

#include "host/model/entity.hpp"
#include "host/sim/plant.hpp"
#include "host/sim/random.hpp"

/// One position servo: encoder, position loop, DC motor, gearbox, housing temperature. It knows no
/// physics engine: before a step it turns the joint's state into a line in the torque-speed plane,
/// which any engine with an implicit velocity motor can apply; after the step it is told what
/// became of it.
namespace verp::sim {

/// The joint's drive during one physics step: torque = slope * (speed - joint speed at the end of
/// the step), within
/// +-limit. Being linear in the new speed it is stable at any stiffness.
struct Drive {
  double speed_rad_s = 0;
  double slope_n_m_s = 0;  ///< never negative; 0: no drive at all
  double limit_n_m = 0;    ///< infinite unless the motor's current limit may act in this step

  double torque_n_m(double rate_rad_s) const;
};

/// Encoder counts of a joint angle and back, as the controller computes them: without zero error,
/// not rounded.
double count_of(const model::Servo& servo, double angle_rad);
double angle_of(const model::Servo& servo, double count);

/// What the datasheets and e-manuals of the X-series say beyond Entity's servo facts, and estimates
/// where silent.
struct ServoConstants {
  /// Stall torque and no-load speed are taken at this supply (e-manual XM430: performance at 12 V).
  double nominal_v = 12.0;
  /// ams AS5045, the encoder named by the e-manuals of MX and X: transition noise 0.03 degrees rms
  /// in slow mode.
  double encoder_noise_deg = 0.03;
  /// Housing of an XM430: 82 g (e-manual) of mostly aluminium, 0.9 kJ/(kg K); 77 cm2 of surface
  /// (28.5 x 46.5 x 34 mm) in still air at 10 W/(m2 K). An estimate: it sets how fast a servo
  /// warms, never whether it walks.
  double heat_capacity_j_k = 74.0;
  double thermal_resistance_k_w = 13.0;
  double ambient_c = 25.0;
  /// Copper's temperature coefficient, IEC 60028.
  double copper_per_k = 0.00393;
  /// XM430 Current Limit register: 1193 units of 2.69 mA, 1.4 times the stall current at 12 V.
  /// Back-driven motors go beyond stall torque up to here.
  double current_limit_stalls = 1.4;
  /// Coulomb friction is replaced by viscous friction below this speed, so a stuck joint creeps
  /// instead of locking.
  double friction_corner_rad_s = 0.02;
  /// End stops: a housing's plastic, stiff enough to hold stall torque within half a degree.
  double stop_stiffness_n_m = 500.0;
  double stop_damping_n_m_s = 1.0;
};

struct ServoNoise {
  bool encoder = true;
  double zero_error_rad = 0;  ///< the encoder reads this much more than the joint's angle
};

class ServoModel {
 public:
  /// Throws std::invalid_argument naming the joint if the servo facts can't drive a motor.
  ServoModel(const model::Joint& joint, const ServoNoise& noise, Random encoder_random,
             double initial_rad, const ServoConstants& constants = {});

  /// Samples the encoder and runs the position loop, once per physics step, as the servo does at 1
  /// kHz.
  Drive drive(const ServoSetpoint& setpoint, double angle_rad, double rate_rad_s, double supply_v,
              double step_s);
  /// The step is over; rate_rad_s is the joint's new speed.
  void finish(double rate_rad_s, double step_s);

  /// Servo sense: positive as counts increase.
  const ServoMeasurement& measurement() const { return measurement_; }
  /// Torque of motor and gearbox on the joint in the last step, joint sense.
  double torque_n_m() const { return torque_n_m_; }
  /// |motor torque| as a part of stall torque; above 1 when back-driven.
  double torque_use() const { return torque_use_; }
  /// The duty asked for was at or beyond the limit in the last step.
  bool saturated() const { return saturated_; }
  /// What this servo draws from the supply.
  double supply_current_a() const { return supply_current_a_; }
  /// Where the profile stands, as the joint's true angle.
  double profile_rad() const {
    return angle_of(joint_.servo, profile_count_) - noise_.zero_error_rad;
  }

 private:
  void sample_encoder(double angle_rad);
  void follow_profile(const ServoSetpoint& setpoint, double step_s);
  double position_loop(const ServoSetpoint& setpoint, double step_s);
  void drive_motor(double rate_rad_s, double supply_v, double step_s);
  bool engage(double rate_rad_s, double step_s);
  Drive with_gearbox(double angle_rad, double rate_rad_s, double step_s) const;

  model::Joint joint_;
  ServoNoise noise_;
  ServoConstants constants_;
  Random random_;
  ServoMeasurement measurement_;
  double resistance_ohm_ = 0;

  bool was_on_ = false;
  std::int32_t goal_count_ = 0;
  double profile_count_ = 0;
  double profile_step_count_s_ = 0;  ///< counts per second until the goal
  double integral_ = 0;              ///< PWM units
  double last_error_ = 0;            ///< counts

  double duty_ = 0;      ///< joint sense
  double play_rad_ = 0;  ///< motor side ahead of joint side, within +-backlash/2
  Drive motor_;          ///< the motor alone, of the last step
  Drive drive_;          ///< with gearbox and end stops
  double torque_n_m_ = 0;
  double torque_use_ = 0;
  double supply_current_a_ = 0;
  bool saturated_ = false;
};

}  // namespace verp::sim
