#include "host/twin/sim/robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "host/robot/model/supply.hpp"
#include "host/twin/sim/coupling.hpp"
#include "host/twin/sim/start.hpp"

namespace verp::sim {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180;
/// Least body height above the feet as a share of its initial value, or largest tilt.
constexpr double kFallenHeight = 0.6;
constexpr double kFallenTilt = 1.0;
// If nobody takes the scans, the oldest are dropped.
constexpr std::size_t kMostScans = 1000;

std::vector<double> mass_factors(const model::Entity& entity, const TwinOptions& options) {
  Random random(options.seed, Draw::kMass);
  std::vector<double> factor(entity.nodes.size(), options.mass_scale);
  for (double& f : factor) f *= 1 + options.mass_spread * random.uniform(-1, 1);
  return factor;
}

}  // namespace

TwinRobot::TwinRobot(World& world, const model::Entity& entity, const TwinOptions& options)
    : world_(world),
      time_(&world),
      entity_(entity),
      options_(options),
      owner_(world.new_owner()),
      body_(world, entity_, mass_factors(entity, options), owner_),
      setpoint_(entity.joints.size()),
      imu_(entity.imu.value_or(model::ImuSensor{}), 1e-6 * entity.period_us,
           options.imperfections.imu, options.seed, options.gyro_bias_rad_s),
      shutters_(entity_, options.cameras),
      probes_(entity_, body_, owner_, options.imperfections.probes, options.seed),
      nominal_v_(options.supply_v.value_or(model::supply_volts(entity_))),
      supply_v_(nominal_v_),
      supply_ohm_(options.supply_ohm.value_or(model::supply_resistance_ohm(entity_))),
      external_n_m_(entity.joints.size(), 0),
      saturated_steps_(entity.joints.size(), 0) {
  const Start start = make_start(entity_, options);
  body_.place(start.body_world, start.joint_rad);
  Random zero_error(options.seed, Draw::kZeroError);
  for (std::size_t j = 0; j < entity_.joints.size(); ++j) {
    ServoNoise noise{.encoder = options.imperfections.encoder};
    const double error = zero_error.uniform(-1, 1) * options.zero_error_deg * kRadPerDegree;
    if (options.imperfections.zero_error) noise.zero_error_rad = error;
    servo_.emplace_back(joint_at_servo(entity_, j, world.step_s()), noise,
                        Random(options.seed, Draw::kEncoder, static_cast<int>(j)),
                        start.joint_rad[j]);
    setpoint_[j].goal_count = servo_[j].measurement().position_count;
  }
  for (int foot = 0; foot < 2; ++foot) {
    const model::Limb* leg = find_leg(entity_, foot);
    if (leg == nullptr) continue;
    foot_node_[static_cast<std::size_t>(foot)] = leg->joints.back() + 1;
    foot_.emplace_back(*leg, entity_.feet.newton_per_count, options.imperfections.feet,
                       Random(options.seed, Draw::kFootNoise, foot));
  }
  for (std::size_t i = 0; i < entity_.lasers.size(); ++i) {
    laser_.emplace_back(entity_.lasers[i], i, owner_, options.imperfections.lasers,
                        Random(options.seed, Draw::kLaser, static_cast<int>(i)));
  }
  TwinOptions upright = options;
  upright.lies = Lies::kNo;
  initial_height_m_ =
      make_start(entity_, upright).body_world.translation().z() - options.start_m.z();
  std::size_t longest = 0;
  for (const model::Joint& joint : entity_.joints) {
    const double delay_s = options.goal_delay_s + joint.servo.goal_delay_s;
    delay_steps_.push_back(static_cast<std::size_t>(std::lround(delay_s / world.step_s())));
    longest = std::max(longest, delay_steps_.back());
  }
  arriving_.assign(longest + 1, setpoint_);
  if (options.cradle != Cradle::kNone && options.lies == Lies::kNo) body_.hold();
  world_.add(*this);
}

TwinRobot::~TwinRobot() {
  world_.remove(*this);
}

ServoRating TwinRobot::rating(int joint) const {
  const model::Servo& servo = entity_.joints[static_cast<std::size_t>(motor_of(joint))].servo;
  return {servo.stall_torque_n_m, servo.stall_current_a, servo.nominal_v};
}

std::array<std::uint16_t, 4> TwinRobot::foot_counts(int foot) {
  const auto index = static_cast<std::size_t>(foot);
  return index < foot_.size() ? foot_[index].counts() : std::array<std::uint16_t, 4>{};
}

FootLoads TwinRobot::take_foot_loads() {
  return std::exchange(loads_, FootLoads{});
}

const ServoSetpoint& TwinRobot::acting(std::size_t joint) const {
  return arriving_[arriving_.size() - 1 - delay_steps_[joint]][joint];
}

void TwinRobot::before_step(double step_s) {
  update_cradle(step_s);
  coupling_ = couplings(entity_, body_, step_s);
  inertia_kg_m2_ = body_.inertias_kg_m2();
  arriving_.push_back(setpoint_);
  arriving_.pop_front();
  for (std::size_t j = 0; j < servo_.size(); ++j) {
    const int joint = static_cast<int>(j);
    coupling_[j] += servo_[j].drive(acting(j), body_.angle_rad(joint), body_.rate_rad_s(joint),
                                    external_n_m_[j], supply_v_, step_s);
    body_.drive(joint, coupling_[j]);
    external_n_m_[j] = -inertia_kg_m2_[j] * body_.rate_rad_s(joint) / step_s;
    saturated_steps_[j] += servo_[j].saturated() ? 1 : 0;
  }
  imu_velocity_world_m_s_ = imu_point_velocity();
}

void TwinRobot::after_step(double step_s) {
  ++steps_;
  body_.read_joints();
  update_servos(step_s);
  update_imu(step_s);
  update_self_contacts();
  update_feet(step_s);
  fallen_ = fallen_ || is_down();
  update_lasers();
  shutters_.sample(world_, *this);
  probes_.sample(world_, body_);
}

std::vector<Transform> TwinRobot::link_poses() const {
  return body_.links_world();
}

bool TwinRobot::set_upright() {
  for (const ServoSetpoint& each : setpoint_) {
    if (each.torque_on) return false;
  }
  const Transform lies = body_.link_pose(0);
  TwinOptions here = options_;
  here.lies = Lies::kNo;
  here.start_m.head<2>() = lies.translation().head<2>();
  here.start_yaw_rad = std::atan2(lies.linear()(1, 0), lies.linear()(0, 0));
  const Start start = make_start(entity_, here);
  body_.release();
  body_.place(start.body_world, start.joint_rad);
  if (options_.cradle != Cradle::kNone) body_.hold();
  armed_s_ = 0;
  fallen_ = false;
  return true;
}

void TwinRobot::update_cradle(double step_s) {
  if (options_.cradle != Cradle::kUntilArmed || !body_.held()) return;
  bool armed = true;
  for (int foot = 0; foot < 2; ++foot) {
    const model::Limb* leg = find_leg(entity_, foot);
    if (leg == nullptr) continue;
    for (const int joint : leg->joints) armed = armed && setpoint(joint).torque_on;
  }
  armed_s_ = armed ? armed_s_ + step_s : 0;
  if (armed_s_ >= options_.cradle_s) body_.release();
}

void TwinRobot::update_servos(double step_s) {
  double current_a = 0;
  for (std::size_t j = 0; j < servo_.size(); ++j) {
    const double rate_rad_s = body_.rate_rad_s(static_cast<int>(j));
    servo_[j].finish(rate_rad_s, step_s);
    // The rest of the world applied what the servo did not.
    external_n_m_[j] += inertia_kg_m2_[j] * rate_rad_s / step_s - servo_[j].torque_n_m();
    current_a += servo_[j].supply_current_a();
    joint_work_j_ += std::max(0.0, servo_[j].torque_n_m() * rate_rad_s) * step_s;
  }
  supply_energy_j_ += supply_v_ * current_a * step_s;
  supply_v_ = nominal_v_ - supply_ohm_ * current_a;
}

Transform TwinRobot::imu_pose() const {
  if (!entity_.imu) return body_.link_pose(0);
  return body_.link_pose(entity_.imu->node) * entity_.imu->pose;
}

Vec3 TwinRobot::imu_point_velocity() const {
  const int node = entity_.imu ? entity_.imu->node : 0;
  return body_.point_velocity_world_m_s(node, imu_pose().translation());
}

void TwinRobot::update_imu(double step_s) {
  const int node = entity_.imu ? entity_.imu->node : 0;
  const Vec3 up_m_s2 = world_.options().gravity_m_s2 * world_.options().up.normalized();
  if (imu_.lies.loose) {
    const Mat3 upright = entity_.imu ? Mat3(entity_.imu->pose.linear()) : Mat3::Identity();
    imu_.sample(upright, Vec3::Zero(), Vec3::Zero(), up_m_s2, step_s);
    return;
  }
  const Vec3 acceleration = (imu_point_velocity() - imu_velocity_world_m_s_) / step_s;
  imu_.sample(imu_pose().linear(), body_.angular_velocity_world_rad_s(node), acceleration, up_m_s2,
              step_s);
}

void TwinRobot::update_self_contacts() {
  for (const Contact& contact : world_.contacts()) {
    if (contact.owner != owner_ || contact.other_owner != owner_) continue;
    self_contact_nodes_ = {contact.node, contact.other_node};
    ++self_contact_steps_;
    return;
  }
}

void TwinRobot::update_feet(double step_s) {
  step_loads_ = FootLoads{};
  foot_force_n_ = {};
  for (FootModel& foot : foot_) foot.begin_step();
  for (const Contact& contact : world_.contacts()) {
    // Contact with the own other foot carries no weight.
    if (contact.owner != owner_ || contact.other_owner == owner_) continue;
    const int foot = foot_of(contact.node);
    if (foot < 0) continue;
    const auto index = static_cast<std::size_t>(foot);
    step_loads_.add(contact.position_world_m, contact.force_world_n);
    const Transform sole = body_.link_pose(contact.node) * find_leg(entity_, foot)->tip;
    const double normal_n = sole.linear().col(2).dot(contact.force_world_n);
    foot_force_n_[index] += contact.force_world_n.z();
    if (index < foot_.size())
      foot_[index].add_load(sole.inverse() * contact.position_world_m, normal_n);
  }
  for (FootModel& foot : foot_) foot.end_step(step_s);
  loads_.add(step_loads_);
}

void TwinRobot::update_lasers() {
  for (std::size_t i = 0; i < laser_.size(); ++i) {
    if (!laser_[i].sample(world_, body_.link_pose(entity_.lasers[i].node))) continue;
    if (scans_.size() == kMostScans) scans_.erase(scans_.begin());
    scans_.push_back(laser_[i].scan());
  }
}

int TwinRobot::foot_of(int node) const {
  if (node == foot_node_[0]) return 0;
  return node == foot_node_[1] ? 1 : -1;
}

bool TwinRobot::is_down() const {
  const Transform body = body_.link_pose(0);
  const double tilt = std::acos(std::clamp(body.linear()(2, 2), -1.0, 1.0));
  // Walking downhill is not a fall.
  double floor_m = std::numeric_limits<double>::infinity();
  for (const int foot : {0, 1}) {
    const FootTruth truth = foot_truth(foot);
    if (truth.present) floor_m = std::min(floor_m, truth.sole_world.translation().z());
  }
  if (!std::isfinite(floor_m)) floor_m = options_.start_m.z();
  return tilt > kFallenTilt || body.translation().z() - floor_m < kFallenHeight * initial_height_m_;
}

bool TwinRobot::forget_fall() {
  if (is_down()) return false;
  fallen_ = false;
  return true;
}

FootTruth TwinRobot::foot_truth(int foot) const {
  const auto index = static_cast<std::size_t>(foot);
  FootTruth truth;
  if (foot_node_[index] < 0) return truth;
  const model::Limb& leg = *find_leg(entity_, foot);
  truth.present = true;
  truth.normal_force_n = foot_force_n_[index];
  truth.contact = truth.normal_force_n > kContactForceN;
  truth.sole_world = body_.link_pose(foot_node_[index]) * leg.tip;
  const Vec3& low = leg.sole_min_m;
  const Vec3& high = leg.sole_max_m;
  truth.corner_world_m = {
      truth.sole_world * Vec3(high.x(), high.y(), 0), truth.sole_world * Vec3(high.x(), low.y(), 0),
      truth.sole_world * Vec3(low.x(), low.y(), 0), truth.sole_world * Vec3(low.x(), high.y(), 0)};
  truth.centroid_world_m =
      truth.sole_world * Vec3((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, 0);
  return truth;
}

Truth TwinRobot::truth() const {
  Truth truth;
  truth.t_s = static_cast<double>(world_.now_us()) * 1e-6;
  truth.body_world = body_.link_pose(0);
  truth.body_velocity_world_m_s = body_.point_velocity_world_m_s(0, truth.body_world.translation());
  truth.body_rate_world_rad_s = body_.angular_velocity_world_rad_s(0);
  const Vec3 rpy = roll_pitch_yaw(truth.body_world.linear());
  truth.roll_rad = rpy.x();
  truth.pitch_rad = rpy.y();
  truth.yaw_rad = rpy.z();
  truth.com_world_m = body_.com_world_m();
  truth.com_velocity_world_m_s = body_.com_velocity_world_m_s();
  truth.zmp_valid = step_loads_.valid();
  if (truth.zmp_valid) truth.zmp_world_m = step_loads_.zmp_world_m();
  std::vector<Vec2> corners;
  for (int foot = 0; foot < 2; ++foot) {
    FootTruth& out = truth.foot[static_cast<std::size_t>(foot)];
    out = foot_truth(foot);
    if (!out.contact) continue;
    for (const Vec3& corner : out.corner_world_m) corners.emplace_back(corner.head<2>());
  }
  truth.support_world_m = convex_hull(std::move(corners));
  truth.joint_rad = body_.angles_rad();
  truth.joint_rad_s = body_.rates_rad_s();
  for (const ServoModel& servo : servo_) {
    truth.torque_n_m.push_back(servo.torque_n_m());
    truth.torque_use.push_back(servo.torque_use());
  }
  truth.held = body_.held();
  truth.fallen = fallen_;
  return truth;
}

}  // namespace verp::sim
