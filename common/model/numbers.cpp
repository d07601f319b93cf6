#include "common/model/numbers.hpp"

#include "common/model/tuning_ranges.hpp"

namespace verp {
namespace {

// Bounds ten times wider than any known robot's.
constexpr Range kPlace_m{-10, 10};
constexpr Range kLength_m{0, 10};
constexpr Range kMass_kg{0, 1000};
constexpr Range kAngle_rad{-100, 100};
constexpr Range kShare{-1.001F, 1.001F};  // of a unit vector or rotation, rounded
constexpr Range kSpeed_rad_s{0.01F, 1000};
constexpr Range kScale_per_rad{1, 1e8F};
constexpr Range kZero_count{-1e9F, 1e9F};
constexpr Range kCompliance_rad_nm{0, 100};
constexpr Range kGyro_rad_s{1e-7F, 1};
constexpr Range kAccel_m_s2{1e-6F, 10};
constexpr Range kForce_n{0, 1000};
constexpr Range kArmature_kg_m2{0, 1000};
constexpr Range kTorque_n_m{0, 1e4F};
constexpr Range kFrictionSpeed_rad_s{1e-3F, 1000};
constexpr Range kAngle_rad_m{-100, 100};
constexpr std::uint32_t kShortest_us = 4000, kLongest_us = 20000;  // Params::period_us

class Search {
 public:
  explicit Search(FieldName& bad) : bad_(bad) {}

  bool found() const { return found_; }
  void in(const char* group, int index = -1) {
    group_ = group;
    index_ = index;
  }
  void check(const char* name, bool fits) {
    if (fits || found_) return;
    found_ = true;
    append(group_);
    if (index_ >= 0) append_index();
    if (*group_ != '\0') append(".");
    append(name);
  }
  // Written so that NaN fails.
  void check(const char* name, float value, const Range& range) {
    check(name, value >= range.low && value <= range.high);
  }
  void check(const char* name, const Xyz& value, const Range& range) {
    for (const float each : {value.x, value.y, value.z}) check(name, each, range);
  }
  template <std::size_t Count>
  void check(const char* name, const float (&values)[Count], const Range& range) {
    for (const float each : values) check(name, each, range);
  }

 private:
  void append(const char* text) {
    while (*text != '\0' && size_ + 1 < kFieldNameLength) bad_.text[size_++] = *text++;
    bad_.text[size_] = '\0';
  }
  void append_index() {
    const char digits[] = {'[', static_cast<char>('0' + index_ / 10),
                           static_cast<char>('0' + index_ % 10), ']', '\0'};
    const char one[] = {'[', digits[2], ']', '\0'};
    append(index_ > 9 ? digits : one);
  }

  FieldName& bad_;
  const char* group_ = "";
  int index_ = -1;
  int size_ = 0;
  bool found_ = false;
};

void look_at_joint(const JointParams& joint, Search& search) {
  search.check("origin_parent_m", joint.origin_parent_m, kPlace_m);
  search.check("axis", joint.axis, kShare);
  search.check("mass_kg", joint.mass_kg, kMass_kg);
  search.check("com_link_m", joint.com_link_m, kPlace_m);
  search.check("lower_rad", joint.lower_rad, kAngle_rad);
  search.check("upper_rad", joint.upper_rad, {joint.lower_rad, kAngle_rad.high});
  search.check("velocity_limit_rad_s", joint.velocity_limit_rad_s, kSpeed_rad_s);
  search.check("counts_per_rad", math::abs(joint.counts_per_rad), kScale_per_rad);
  search.check("zero_count", joint.zero_count, kZero_count);
  search.check("compliance_rad_nm", joint.compliance_rad_nm, kCompliance_rad_nm);
  search.check("armature_kg_m2", joint.armature_kg_m2, kArmature_kg_m2);
  search.check("friction_n_m", joint.friction_n_m, kTorque_n_m);
  search.check("load_friction", joint.load_friction, {0, 1});
  search.check("friction_speed_rad_s", joint.friction_speed_rad_s, kFrictionSpeed_rad_s);
  search.check("stand_rad", joint.stand_rad, kAngle_rad);
  search.check("sit_rad", joint.sit_rad, kAngle_rad);
}

void look_at_leg(const LegParams& leg, Search& search) {
  search.check("direction", leg.direction, kShare);
  search.check("offset_rad", leg.offset_rad, kAngle_rad);
  search.check("hip_body_m", leg.hip_body_m, kPlace_m);
  search.check("thigh_m", leg.thigh_m, kLength_m);
  search.check("shank_m", leg.shank_m, kLength_m);
  search.check("sole_foot_m", leg.sole_foot_m, kPlace_m);
  search.check("sole_foot", leg.sole_foot, kShare);
  search.check("sole_front_m", leg.sole_front_m, kLength_m);
  search.check("sole_back_m", leg.sole_back_m, kLength_m);
  search.check("sole_left_m", leg.sole_left_m, kLength_m);
  search.check("sole_right_m", leg.sole_right_m, kLength_m);
}

void look_at_tuning(const Tuning& tuning, Search& search) {
  int id = 0;
  const auto look = [&](const char* name, const float& value) {
    search.check(name, value, kTuningRanges[id++]);
  };
  search.in("tuning.gait");
  GaitTuning::fields(tuning.gait, look);
  search.in("tuning.balance");
  BalanceTuning::fields(tuning.balance, look);
  search.in("tuning.safety");
  SafetyTuning::fields(tuning.safety, look);
}

}  // namespace

bool numbers_fit(const Params& params, FieldName& bad) {
  bad = {};
  Search search(bad);
  search.check("period_us", params.period_us >= kShortest_us && params.period_us <= kLongest_us);
  search.check("baud", params.baud > 0);
  search.check("body_mass_kg", params.body_mass_kg, kMass_kg);
  search.check("body_com_m", params.body_com_m, kPlace_m);
  search.check("arm_rad_per_m", params.arm_rad_per_m, kAngle_rad_m);
  for (int j = 0; j < params.joint_count; ++j) {
    search.in("joint", j);
    look_at_joint(params.joint[j], search);
  }
  if (params.joint_count == 0) {  // legs without a solver name joint 0, and the gait reads it
    search.in("joint", 0);
    search.check("mass_kg", params.joint[0].mass_kg, kMass_kg);
    search.check("stand_rad", params.joint[0].stand_rad, kAngle_rad);
  }
  for (int side = 0; side < kFeet; ++side) {
    if (params.leg[side].solver == LegSolver::kNone) continue;
    search.in("leg", side);
    look_at_leg(params.leg[side], search);
  }
  search.in("imu");
  search.check("body_imu", params.imu.body_imu, kShare);
  search.check("gyro_rad_s_per_count", params.imu.gyro_rad_s_per_count, kGyro_rad_s);
  search.check("accel_m_s2_per_count", params.imu.accel_m_s2_per_count, kAccel_m_s2);
  search.in("feet");
  search.check("newton_per_count", params.feet.newton_per_count, kForce_n);
  look_at_tuning(params.tuning, search);
  return !search.found();
}

}  // namespace verp
