#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/body.hpp"
#include "host/twin/sim/laser.hpp"
#include "host/twin/sim/plant.hpp"
#include "host/twin/sim/probes.hpp"
#include "host/twin/sim/sensors.hpp"
#include "host/twin/sim/servo.hpp"
#include "host/twin/sim/shutters.hpp"
#include "host/twin/sim/truth.hpp"
#include "host/twin/sim/world.hpp"

namespace verp::sim {

/// All on: the real robot. All off: tests and finding a cause.
struct Imperfections {
  bool imu = true;           ///< noise and bias
  bool encoder = true;       ///< noise (quantisation stays)
  bool zero_error = true;    ///< joint zeros are off by up to zero_error_deg
  bool initial_pose = true;  ///< joints, lean and heading
  bool feet = true;          ///< force noise
  bool lasers = true;        ///< noise
  bool probes = true;        ///< of force-torque and truth sensors

  static Imperfections none() { return {false, false, false, false, false, false, false}; }
};

/// A standing robot must be held until armed, because servos power up limp.
enum class Cradle { kNone, kUntilArmed, kAlways };

/// Start: standing, or lying on a side; kAny: drawn from the seed.
enum class Lies { kNo, kFront, kBack, kLeft, kRight, kAny };

struct TwinOptions {
  std::uint64_t seed = 1;
  Imperfections imperfections = {};
  double zero_error_deg = 0.5;           ///< uniform in +- this
  double mass_scale = 1.0;               ///< of every link
  double mass_spread = 0.0;              ///< each link: 1 +- this
  double goal_delay_s = 0;               ///< from arrival to the servo's action
  Vec3 gyro_bias_rad_s = Vec3::Zero();   ///< sensor axes, besides the drawn bias
  std::vector<double> initial_rad = {};  ///< empty: Entity's stand_rad
  Vec3 start_m = Vec3::Zero();           ///< midpoint of the soles; z: ground height there
  double start_yaw_rad = 0;
  Lies lies = Lies::kNo;  ///< not held if lying
  Cradle cradle = Cradle::kUntilArmed;
  /// Release after torque-on of all leg servos. The firmware then stands (rise_s is 1 s) and does
  /// not walk yet.
  double cradle_s = 1.2;
  std::optional<double> supply_v = {};    ///< unloaded; none: the robot's
  std::optional<double> supply_ohm = {};  ///< battery and harness; none: the robot's
  bool cameras = false;                   ///< cameras are rendered: take_exposures()
};

/// One robot in a World. Plant is for the controller, in counts; truth() for the referee.
class TwinRobot final : public Plant, private Actor {
 public:
  /// Throws std::invalid_argument with the link or joint.
  TwinRobot(World& world, const model::Entity& entity, const TwinOptions& options = {});
  ~TwinRobot() override;
  TwinRobot(const TwinRobot&) = delete;
  TwinRobot& operator=(const TwinRobot&) = delete;

  std::uint64_t now_us() const override { return world_.now_us(); }
  void advance_to(std::uint64_t time_us) override { time_->advance_to(time_us); }
  /// For a follower: the set-point of its driver's servo.
  ServoSetpoint& setpoint(int joint) override {
    return setpoint_[static_cast<std::size_t>(motor_of(joint))];
  }
  ServoMeasurement measure(int joint) override { return servo(motor_of(joint)).measurement(); }
  ServoRating rating(int joint) const override;
  ImuMeasurement imu() override { return imu_.measurement(); }
  std::array<std::uint16_t, 4> foot_counts(int foot) override;

  /// Requests time there instead of from the world; `time` must outlive the robot.
  void set_time(TimeSource& time) { time_ = &time; }

  const model::Entity& entity() const { return entity_; }
  const ServoModel& servo(int joint) const { return servo_[static_cast<std::size_t>(joint)]; }
  const Body& body() const { return body_; }
  Body& body() { return body_; }
  ImuLies& imu_lies() { return imu_.lies; }
  ServoModel& servo(int joint) { return servo_[static_cast<std::size_t>(joint)]; }
  int owner() const { return owner_; }
  Truth truth() const;
  /// Releases in any state of the cradle.
  void release() { body_.release(); }
  bool fallen() const { return fallen_; }
  /// Resets fallen() if the robot stands as one that never fell; false: it does not.
  bool forget_fall();
  /// Holds a limp robot upright where it lies, as at the start (Cradle). False: a servo has torque.
  bool set_upright();
  double supply_v() const { return supply_v_; }
  void set_unloaded_v(double supply_v) { nominal_v_ = supply_v; }
  /// Energy since the start from the supply, and work on the joints without braking.
  double supply_energy_j() const { return supply_energy_j_; }
  double joint_work_j() const { return joint_work_j_; }
  double weight_n() const { return body_.mass_kg() * world_.options().gravity_m_s2; }
  /// Steps since the start; per joint, steps with duty at its limit.
  std::uint64_t steps() const { return steps_; }
  /// Scans that became available since the last call, with the time of each.
  std::vector<Scan> take_scans() { return std::exchange(scans_, {}); }
  std::vector<Exposure> take_exposures() { return shutters_.take(); }
  ProbeReadings take_readings() { return probes_.take(); }
  const std::vector<std::uint64_t>& saturated_steps() const { return saturated_steps_; }

  /// Steps with self-contact, and the last two links.
  std::uint64_t self_contact_steps() const { return self_contact_steps_; }
  std::array<int, 2> self_contact_nodes() const { return self_contact_nodes_; }

  /// Loads since the last call: a control tick's mean.
  FootLoads take_foot_loads();

 private:
  int motor_of(int joint) const {
    const int driver = entity_.joints[static_cast<std::size_t>(joint)].follows;
    return driver < 0 ? joint : driver;
  }
  void before_step(double step_s) override;
  void after_step(double step_s) override;
  std::vector<Transform> link_poses() const override;
  const ServoSetpoint& acting(std::size_t joint) const;
  void update_cradle(double step_s);
  void update_servos(double step_s);
  void update_imu(double step_s);
  void update_self_contacts();
  void update_feet(double step_s);
  bool is_down() const;
  void update_lasers();
  FootTruth foot_truth(int foot) const;
  Transform imu_pose() const;
  Vec3 imu_point_velocity() const;
  int foot_of(int node) const;

  World& world_;
  TimeSource* time_;
  const model::Entity entity_;
  const TwinOptions options_;
  const int owner_;
  Body body_;
  std::vector<ServoModel> servo_;
  std::vector<ServoSetpoint> setpoint_;
  std::deque<std::vector<ServoSetpoint>> arriving_;  ///< oldest first
  std::vector<std::size_t> delay_steps_;             ///< of each joint
  ImuModel imu_;
  std::vector<FootModel> foot_;  ///< none, or two
  std::array<int, 2> foot_node_{-1, -1};
  std::vector<LaserModel> laser_;
  std::vector<Scan> scans_;
  Shutters shutters_;
  Probes probes_;
  Vec3 imu_velocity_world_m_s_ = Vec3::Zero();
  FootLoads step_loads_;  ///< of the last step
  FootLoads loads_;
  std::array<double, 2> foot_force_n_{};
  double nominal_v_;  ///< of the supply, unloaded
  double supply_v_;
  const double supply_ohm_;
  double supply_energy_j_ = 0, joint_work_j_ = 0;
  std::vector<double> inertia_kg_m2_;  ///< at the start of the step
  std::vector<double> external_n_m_;   ///< besides the servo's, last step
  std::vector<Drive> coupling_;        ///< per joint, this step
  double armed_s_ = 0;
  double initial_height_m_ = 0;
  bool fallen_ = false;
  std::uint64_t steps_ = 0;
  std::vector<std::uint64_t> saturated_steps_;
  std::uint64_t self_contact_steps_ = 0;
  std::array<int, 2> self_contact_nodes_{};
};

}  // namespace verp::sim
