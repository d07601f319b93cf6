#include "host/robot/model/params.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/arms.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {
namespace {

constexpr double kFullDuty = 885;  // e-Manual X series, PWM Limit(36): 885 is 100 %

Xyz to_xyz(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void to_rows(const Mat3& m, float (&rows)[9]) {
  for (int i = 0; i < 9; ++i) rows[i] = static_cast<float>(m(i / 3, i % 3));
}

void put_name(const std::string& name, char (&place)[kNameLength]) {
  const std::string short_one = short_name(name);
  std::memcpy(place, short_one.c_str(), short_one.size());
}

AxisKind kind_of(const Vec3& axis) {
  constexpr AxisKind kPlus[] = {AxisKind::kX, AxisKind::kY, AxisKind::kZ};
  constexpr AxisKind kMinus[] = {AxisKind::kMinusX, AxisKind::kMinusY, AxisKind::kMinusZ};
  for (int i = 0; i < 3; ++i) {
    if (axis == Vec3::Unit(i)) return kPlus[i];
    if (axis == -Vec3::Unit(i)) return kMinus[i];
  }
  return AxisKind::kGeneral;
}

std::uint8_t profile_index(const Entity& entity, const Servo& servo, Params& params) {
  const ServoProfile wanted{
      servo.model_number, servo.p_gain,
      servo.i_gain,       servo.d_gain,
      servo.profile_ms,   static_cast<std::uint16_t>(servo.fast_sync_read ? 1 : 0)};
  for (int i = 0; i < kServoProfiles; ++i) {
    ServoProfile& slot = params.servo[i];
    if (slot.model_number == 0) slot = wanted;
    if (std::memcmp(&slot, &wanted, sizeof wanted) == 0) return static_cast<std::uint8_t>(i);
  }
  throw LoadError(entity.file, 1,
                  "more than " + std::to_string(kServoProfiles) + " kinds of servo settings",
                  "use the same type, gains and profile_ms for more joints");
}

/// Counts and compliance through the coupling.
void follow(const Joint& joint, JointParams& p) {
  const double counts_per_rad =
      joint.servo.direction * joint.servo.counts_per_rev / (2 * std::numbers::pi);
  p.counts_per_rad = static_cast<float>(counts_per_rad / joint.ratio);
  p.zero_count = static_cast<float>(joint.servo.offset_count -
                                    counts_per_rad * joint.offset_rad / joint.ratio);
  p.compliance_rad_nm =
      static_cast<float>(joint.ratio * joint.ratio / servo_stiffness_n_m_rad(joint.servo));
  p.armature_kg_m2 = 0;
  p.friction_n_m = static_cast<float>(joint.friction_n_m);
}

/// While the motor holds a load, each side has half of what the gears bear.
double held_load_share(const Gearbox& gears) {
  const double motor = gears.l_base + gears.l_strib;
  if (!gears.is_directional) return motor;
  return (motor + gears.l_external + gears.l_external_strib) / 2;
}

JointParams joint_params(const Entity& entity, std::size_t j, Params& params) {
  const Joint& joint = entity.joints[j];
  const Node& link = entity.nodes[j + 1];
  const Servo& servo = joint.servo;
  JointParams p;
  put_name(joint.name, p.name);
  p.parent = static_cast<std::uint8_t>(joint.parent);
  p.axis_kind = kind_of(joint.axis);
  p.servo_id = static_cast<std::uint8_t>(servo.id);
  p.servo_profile = profile_index(entity, servo, params);
  p.origin_parent_m = to_xyz(joint.origin_m);
  p.axis = to_xyz(joint.axis);
  p.mass_kg = static_cast<float>(link.mass_kg);
  p.com_link_m = to_xyz(link.com_m);
  p.lower_rad = static_cast<float>(joint.lower_rad);
  p.upper_rad = static_cast<float>(joint.upper_rad);
  p.velocity_limit_rad_s = static_cast<float>(joint.velocity_limit_rad_s);
  p.counts_per_rad =
      static_cast<float>(servo.direction * servo.counts_per_rev / (2 * std::numbers::pi));
  p.zero_count = static_cast<float>(servo.offset_count);
  p.compliance_rad_nm = static_cast<float>(1 / servo_stiffness_n_m_rad(servo));
  const Gearbox& gears = servo.gearbox;
  p.armature_kg_m2 = static_cast<float>(gears.armature_kg_m2);
  p.friction_n_m = static_cast<float>(joint.friction_n_m + gears.f_base_n_m + gears.f_strib_n_m);
  p.load_friction = static_cast<float>(held_load_share(gears));
  p.friction_speed_rad_s = static_cast<float>(gears.w_s_rad_s);
  if (joint.follows >= 0) follow(joint, p);
  p.stand_rad = static_cast<float>(joint.stand_rad);
  p.sit_rad = static_cast<float>(joint.sit_rad);
  return p;
}

LegParams leg_params(const Entity& entity, const Limb& limb) {
  const LegGeometry g = classify_leg(entity, limb);
  LegParams leg;
  leg.solver = g.closed_form ? LegSolver::kClosedForm : LegSolver::kNewton;
  for (std::size_t k = 0; k < kLegJoints; ++k) {
    leg.joint[k] = static_cast<std::uint8_t>(g.joint[k]);  // -1: kNoJoint
    leg.direction[k] = static_cast<float>(g.direction[k]);
    leg.offset_rad[k] = static_cast<float>(g.offset_rad[k]);
  }
  leg.hip_body_m = to_xyz(g.hip_m);
  leg.thigh_m = static_cast<float>(g.thigh_m);
  leg.shank_m = static_cast<float>(g.shank_m);
  leg.sole_foot_m = to_xyz(limb.tip.translation());
  to_rows(limb.tip.linear(), leg.sole_foot);
  leg.sole_front_m = static_cast<float>(limb.sole_max_m.x());
  leg.sole_back_m = static_cast<float>(-limb.sole_min_m.x());
  leg.sole_left_m = static_cast<float>(limb.sole_max_m.y());
  leg.sole_right_m = static_cast<float>(-limb.sole_min_m.y());
  return leg;
}

ImuParams imu_params(const ImuSensor& imu) {
  ImuParams p;
  to_rows(imu.pose.linear(), p.body_imu);
  p.gyro_rad_s_per_count = static_cast<float>(imu.gyro_rad_s_per_count);
  p.accel_m_s2_per_count = static_cast<float>(imu.accel_m_s2_per_count);
  p.device_id = static_cast<std::uint8_t>(imu.id);
  return p;
}

void find_head(const Entity& entity, Params& params) {
  const Limb* const head = find_limb(entity, "head");
  if (!head) return;
  for (const int j : head->joints) {
    if (j >= params.servo_count()) continue;
    const Vec3& axis = entity.joints[static_cast<std::size_t>(j)].axis;
    if (params.head_pan == 0xFF && std::abs(axis.z()) > 0.9)
      params.head_pan = static_cast<std::uint8_t>(j);
    if (params.head_tilt == 0xFF && std::abs(axis.y()) > 0.9)
      params.head_tilt = static_cast<std::uint8_t>(j);
  }
}

}  // namespace

std::string short_name(const std::string& name) {
  if (name.size() < kNameLength) return name;
  std::uint32_t hash = 2166136261U;  // FNV-1a, www.isthe.com/chongo/tech/comp/fnv
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  std::size_t length = kNameLength - 6;
  while (length > 0 && (static_cast<unsigned char>(name[length]) & 0xC0) == 0x80)
    --length;  // UTF-8
  return fmt::format("{}_{:04x}", name.substr(0, length), hash >> 16);
}

double servo_stiffness_n_m_rad(const Servo& servo) {
  const double counts_per_rad = servo.counts_per_rev / (2 * std::numbers::pi);
  return servo.stall_torque_n_m * servo.p_gain / servo.p_gain_unit * counts_per_rad / kFullDuty;
}

const std::vector<std::string>& tuning_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    Tuning tuning;
    Tuning::fields(tuning, [&](const char* group_name, auto& group) {
      std::remove_reference_t<decltype(group)>::fields(group, [&](const char* field_name, float&) {
        names.push_back(std::string(group_name) + "." + field_name);
      });
    });
    return names;
  }();
  return kNames;
}

std::optional<int> tuning_id(const std::string& name) {
  const auto& names = tuning_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<int>(found - names.begin());
}

Params make_params(const Entity& entity) {
  Params params;
  put_name(entity.name, params.name);
  params.period_us = entity.period_us;
  params.rise_torque_percent = entity.rise_torque_percent;
  params.baud = entity.baud;
  params.bus_protocol = entity.protocol;
  params.joint_count = static_cast<std::uint8_t>(entity.joints.size());
  params.body_mass_kg = static_cast<float>(entity.nodes[0].mass_kg);
  params.body_com_m = to_xyz(entity.nodes[0].com_m);
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    params.joint[j] = joint_params(entity, j, params);
    if (entity.joints[j].follows >= 0) ++params.followers;
  }
  const char* const legs[kFeet] = {"left_leg", "right_leg"};
  for (int foot = 0; foot < kFeet; ++foot) {
    if (const Limb* const leg = find_limb(entity, legs[foot]))
      params.leg[foot] = leg_params(entity, *leg);
  }
  find_head(entity, params);
  find_arms(entity, params);
  if (entity.imu) params.imu = imu_params(*entity.imu);
  for (std::size_t foot = 0; foot < kFeet; ++foot) {
    params.feet.device_id[foot] = static_cast<std::uint8_t>(entity.feet.id[foot]);
  }
  params.feet.newton_per_count = static_cast<float>(entity.feet.newton_per_count);
  for (const auto& [name, value] : entity.tuning) {
    if (const auto id = tuning_id(name))
      set_tuning_value(params.tuning, *id, static_cast<float>(value));
  }
  return params;
}

}  // namespace verp::model
