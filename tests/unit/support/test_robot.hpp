#pragma once
#include <cstdint>

#include "common/math/linear.hpp"
#include "common/model/params.hpp"

/// 21 joints with generic21's numbers, because microcontrollers read no SDF. Left and right mirror
/// about y = 0.
namespace verp::test {

/// Numerical Recipes' linear congruential generator.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  std::uint32_t bits() {
    const std::uint32_t high = next() & 0xFFFF0000u;
    return high | (next() >> 16);
  }
  float between(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 8) * 0x1p-24F);
  }
  int below(int count) {
    return static_cast<int>((next() >> 8) % static_cast<std::uint32_t>(count));
  }

 private:
  std::uint32_t next() { return state_ = state_ * 1664525u + 1013904223u; }
  std::uint32_t state_;
};

inline constexpr int kHead = 0, kLeftArm = 3, kRightArm = 6, kLeftLeg = 9, kRightLeg = 15;
inline constexpr int kJointCount = 21;

struct JointRow {
  const char* name;
  std::uint8_t parent;
  AxisKind axis;
  std::uint8_t servo_id;
  std::int8_t direction;
  Xyz origin_m;
  float mass_kg;
  Xyz com_m;
  float lower_rad, upper_rad, stand_rad, sit_rad;
};

// clang-format off
inline constexpr JointRow kRows[kJointCount] = {
    {"head_yaw", 0, AxisKind::kZ, 19, 1, {0, 0, 0.085F}, 0.097F, {0, 0, 0.0125F}, -2, 2, 0, 0},
    {"head_pitch", 1, AxisKind::kY, 20, 1, {0, 0, 0.025F}, 0.097F, {-0.01F, 0, 0}, -0.6F, 1, 0, 0},
    {"head_roll", 2, AxisKind::kX, 21, 1, {0, 0, 0}, 0.1F, {0.01F, 0, 0.05F}, -0.6F, 0.6F, 0, 0},
    {"l_shoulder_pitch", 0, AxisKind::kY, 2, 1, {0, 0.07F, 0.065F}, 0.03F, {0, 0.01F, 0}, -2.9F, 2.9F, 0.3F, 0.3F},
    {"l_shoulder_roll", 4, AxisKind::kX, 4, 1, {0, 0.015F, 0}, 0.174F, {0, 0, -0.03F}, -0.3F, 2.6F, 0.15F, 0.15F},
    {"l_elbow", 5, AxisKind::kY, 6, 1, {0, 0, -0.06F}, 0.08F, {0, 0, -0.05F}, -2.4F, 0.1F, -0.6F, -0.6F},
    {"r_shoulder_pitch", 0, AxisKind::kY, 1, -1, {0, -0.07F, 0.065F}, 0.03F, {0, -0.01F, 0}, -2.9F, 2.9F, 0.3F, 0.3F},
    {"r_shoulder_roll", 7, AxisKind::kX, 3, 1, {0, -0.015F, 0}, 0.174F, {0, 0, -0.03F}, -2.6F, 0.3F, -0.15F, -0.15F},
    {"r_elbow", 8, AxisKind::kY, 5, -1, {0, 0, -0.06F}, 0.08F, {0, 0, -0.05F}, -2.4F, 0.1F, -0.6F, -0.6F},
    {"l_hip_yaw", 0, AxisKind::kZ, 8, 1, {0, 0.037F, -0.085F}, 0.03F, {0, 0, 0}, -1.2F, 1.2F, 0, 0},
    {"l_hip_roll", 10, AxisKind::kX, 10, 1, {0, 0, 0}, 0.18F, {-0.01F, 0, 0}, -0.45F, 0.9F, 0, 0},
    {"l_hip_pitch", 11, AxisKind::kY, 12, 1, {0, 0, 0}, 0.12F, {0, 0, -0.05F}, -1.9F, 0.7F, -0.628F, -1.1F},
    {"l_knee", 12, AxisKind::kY, 14, 1, {0, 0, -0.093F}, 0.06F, {0, 0, -0.045F}, 0, 2.3F, 1.256F, 2.2F},
    {"l_ankle_pitch", 13, AxisKind::kY, 16, 1, {0, 0, -0.093F}, 0.18F, {-0.01F, 0, 0}, -1.3F, 1, -0.628F, -1.1F},
    {"l_ankle_roll", 14, AxisKind::kX, 18, 1, {0, 0, 0}, 0.08F, {0, 0, -0.0285F}, -0.8F, 0.6F, 0, 0},
    {"r_hip_yaw", 0, AxisKind::kZ, 7, 1, {0, -0.037F, -0.085F}, 0.03F, {0, 0, 0}, -1.2F, 1.2F, 0, 0},
    {"r_hip_roll", 16, AxisKind::kX, 9, 1, {0, 0, 0}, 0.18F, {-0.01F, 0, 0}, -0.9F, 0.45F, 0, 0},
    {"r_hip_pitch", 17, AxisKind::kY, 11, -1, {0, 0, 0}, 0.12F, {0, 0, -0.05F}, -1.9F, 0.7F, -0.628F, -1.1F},
    {"r_knee", 18, AxisKind::kY, 13, -1, {0, 0, -0.093F}, 0.06F, {0, 0, -0.045F}, 0, 2.3F, 1.256F, 2.2F},
    {"r_ankle_pitch", 19, AxisKind::kY, 15, -1, {0, 0, -0.093F}, 0.18F, {-0.01F, 0, 0}, -1.3F, 1, -0.628F, -1.1F},
    {"r_ankle_roll", 20, AxisKind::kX, 17, 1, {0, 0, 0}, 0.08F, {0, 0, -0.0285F}, -0.6F, 0.8F, 0, 0},
};
// clang-format on

inline Xyz unit_axis(AxisKind kind) {
  return {kind == AxisKind::kX ? 1.0F : 0.0F, kind == AxisKind::kY ? 1.0F : 0.0F,
          kind == AxisKind::kZ ? 1.0F : 0.0F};
}

inline void make_joint(const JointRow& row, JointParams& joint) {
  for (int i = 0; row.name[i] != '\0'; ++i) joint.name[i] = row.name[i];
  joint.parent = row.parent;
  joint.axis_kind = row.axis;
  joint.axis = unit_axis(row.axis);
  joint.servo_id = row.servo_id;
  joint.origin_parent_m = row.origin_m;
  joint.mass_kg = row.mass_kg;
  joint.com_link_m = row.com_m;
  joint.lower_rad = row.lower_rad;
  joint.upper_rad = row.upper_rad;
  joint.velocity_limit_rad_s = 8.06F;
  joint.counts_per_rad = static_cast<float>(row.direction) * 651.8986F;
  joint.zero_count = 2048;
  joint.compliance_rad_nm = 0.0263F;
  joint.stand_rad = row.stand_rad;
  joint.sit_rad = row.sit_rad;
}

inline void make_leg(int first_joint, float side, LegParams& leg) {
  leg.solver = LegSolver::kClosedForm;
  for (int k = 0; k < kLegJoints; ++k) {
    leg.joint[k] = static_cast<std::uint8_t>(first_joint + k);
    leg.direction[k] = 1;
  }
  leg.hip_body_m = {0, side * 0.037F, -0.085F};
  leg.thigh_m = leg.shank_m = 0.093F;
  leg.sole_foot_m = {0, 0, -0.0335F};
  leg.sole_front_m = leg.sole_back_m = 0.052F;
  leg.sole_left_m = leg.sole_right_m = 0.033F;
}

inline Params make_robot() {
  Params params;
  for (int i = 0; i < 4; ++i) params.name[i] = "test"[i];
  params.joint_count = kJointCount;
  params.head_pan = kHead;
  params.head_tilt = kHead + 1;
  params.arm[0] = kLeftArm;
  params.arm[1] = kRightArm;
  params.arm_rad_per_m[0] = 4;
  params.arm_rad_per_m[1] = -4;
  params.body_mass_kg = 1.1F;
  params.body_com_m = {0, 0, 0.003F};
  for (int j = 0; j < kJointCount; ++j) make_joint(kRows[j], params.joint[j]);
  make_leg(kLeftLeg, 1, params.leg[0]);
  make_leg(kRightLeg, -1, params.leg[1]);
  params.servo[0].model_number = 1030;
  params.imu.gyro_rad_s_per_count = 0.00106F;
  params.imu.accel_m_s2_per_count = 0.0012F;
  params.imu.device_id = 120;
  params.feet.device_id[0] = 111;
  params.feet.device_id[1] = 112;
  params.feet.newton_per_count = 0.01F;
  return params;
}

inline const Params kRobot = make_robot();

/// Its hip and ankle axes do not meet: only Newton solves its legs.
inline Params make_offset_robot() {
  Params params = make_robot();
  for (const int first : {kLeftLeg, kRightLeg}) {
    params.joint[first + 1].origin_parent_m = {-0.01F, 0, -0.012F};
    params.joint[first + 2].origin_parent_m = {0.01F, 0, 0};
    params.joint[first + 5].origin_parent_m = {0.004F, 0, -0.006F};
  }
  for (LegParams& leg : params.leg) leg.solver = LegSolver::kNewton;
  return params;
}

/// Drawn with knees bent 15 degrees the wrong way: at angle zero the feet are flat.
inline Params make_hyperextended_robot() {
  Params params = make_robot();
  constexpr float kBack_rad = 0.2617994F, kSin = 0.2588190F, kCos = 0.9659258F;
  for (const int first : {kLeftLeg, kRightLeg}) {
    params.joint[first + 4].origin_parent_m = {0.093F * kSin, 0, -0.093F * kCos};
    params.joint[first + 3].upper_rad += kBack_rad;
    params.joint[first + 3].stand_rad += kBack_rad;
    params.joint[first + 3].sit_rad += kBack_rad;
    for (float* const angle_rad :
         {&params.joint[first + 4].lower_rad, &params.joint[first + 4].upper_rad,
          &params.joint[first + 4].stand_rad, &params.joint[first + 4].sit_rad}) {
      *angle_rad -= kBack_rad;
    }
  }
  for (LegParams& leg : params.leg) leg.solver = LegSolver::kNewton;
  return params;
}

inline Params make_massless_legs_robot() {
  Params params = make_robot();
  for (int j = kLeftLeg; j < kJointCount; ++j) params.joint[j].mass_kg = 0;
  return params;
}

/// Inside the limits; knees bent by at least `least_knee_rad`.
inline void random_angles(const Params& params, float least_knee_rad, Random& random,
                          float* angle_rad) {
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const bool knee = j == kLeftLeg + 3 || j == kRightLeg + 3;
    angle_rad[j] =
        random.between(knee ? joint.lower_rad + least_knee_rad : joint.lower_rad, joint.upper_rad);
  }
}

inline Vec3 mirrored(const Vec3& v) {
  return {v.x(), -v.y(), v.z()};
}
inline Mat3 mirrored(const Mat3& m) {
  Mat3 result = m;
  for (const int i : {0, 2}) {
    result(i, 1) = -m(i, 1);
    result(1, i) = -m(1, i);
  }
  return result;
}
inline Pose mirrored(const Pose& pose) {
  return {mirrored(pose.rotation), mirrored(pose.position_m)};
}
/// Left and right swap; turns about x and z change sign.
inline void mirror_angles(const float* angle_rad, float* result_rad) {
  for (int j = 0; j < kJointCount; ++j) {
    int from = j;
    if (j >= kLeftArm && j < kLeftLeg) from = j < kRightArm ? j + 3 : j - 3;
    if (j >= kLeftLeg) from = j < kRightLeg ? j + 6 : j - 6;
    result_rad[j] = kRows[j].axis == AxisKind::kY ? angle_rad[from] : -angle_rad[from];
  }
}

inline float distance(const Vec3& a, const Vec3& b) {
  return math::norm(a - b);
}
inline float turn_between(const Mat3& a, const Mat3& b) {
  return math::norm(math::rotation_vector(a * b.transpose()));
}
inline bool all_finite(const float* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (!math::is_finite(values[i])) return false;
  }
  return true;
}
/// No NaN or infinity.
template <class T>
bool struct_is_finite(const T& data) {
  bool finite = true;
  for_each_leaf(data, [&](const auto& leaf) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(leaf)>, float>) {
      finite = finite && math::is_finite(leaf);
    }
  });
  return finite;
}

inline float quiet_nan() {
  return std::numeric_limits<float>::quiet_NaN();
}
inline float infinity() {
  return std::numeric_limits<float>::infinity();
}

}  // namespace verp::test
