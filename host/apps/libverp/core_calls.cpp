#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "common/control/step.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/counts.hpp"
#include "common/model/leg.hpp"
#include "host/apps/libverp/core_plan.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/handles.hpp"
#include "host/apps/libverp/robot_file.hpp"
#include "host/apps/libverp/velocity.hpp"

using namespace verp::abi;

namespace {

struct Core {
  verp::Params params;
  verp::State state = {};
};

Handles<Core>& cores() {
  static Handles<Core> all("core", 2);
  return all;
}

const verp::JointParams& joint_of(const Core& core, std::uint32_t joint) {
  if (joint < core.params.joint_count) return core.params.joint[joint];
  throw Failure(VERP_BAD_ARGUMENT, "there is no joint " + std::to_string(joint) +
                                       ": the robot has " +
                                       std::to_string(core.params.joint_count));
}

const verp::LegParams& leg_of(const Core& core, std::uint32_t side) {
  if (side >= verp::kFeet) throw Failure(VERP_BAD_ARGUMENT, "side is neither 0 nor 1");
  if (core.params.leg[side].solver == verp::LegSolver::kNone)
    throw Failure(VERP_BAD_ARGUMENT, "the robot has no legs");
  return core.params.leg[side];
}

/// Throws for numbers that are not finite: no result would be finite.
void need_finite(const float* values, std::size_t count, const char* name) {
  for (std::size_t i = 0; i < count; ++i) {
    finite(values[i], (std::string(name) + "[" + std::to_string(i) + "]").c_str());
  }
}

void need_all_joints(const Core& core, const float* angle_rad, std::uint32_t joints) {
  need_size(4ULL * joints, 4ULL * core.params.joint_count, "angle_rad");
  need_finite(angle_rad, joints, "angle_rad");
}

/// A scaled, sheared or mirrored matrix has no angles. The tolerance admits rotations rounded to a
/// few digits.
void need_rotation(const float* from, const char* name) {
  constexpr double kTolerance = 1e-3;
  Eigen::Matrix3d r;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = static_cast<double>(from[i]);
  const double off = (r * r.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off <= kTolerance && r.determinant() > 0) return;
  throw Failure(VERP_BAD_ARGUMENT,
                fmt::format("{}'s first nine numbers are no rotation: R R^T is off 1 by {:.3g} "
                            "(at most {:g}), its determinant is {:.3g}",
                            name, off, kTolerance, r.determinant()));
}

verp::Pose pose_from(const float* from) {
  verp::Pose pose;
  for (int i = 0; i < 9; ++i) pose.rotation(i / 3, i % 3) = from[i];
  for (int i = 0; i < 3; ++i) pose.position_m(i) = from[9 + i];
  return pose;
}

}  // namespace

int verp_core_open(const char* model, const char* bus, const char* tuning, verp_core* core) {
  return call("verp_core_open", [&] {
    need(core, "core");
    *core = nullptr;
    *core = cores().add<verp_core>(std::make_shared<Core>(Core{load(model, bus, tuning).params}));
  });
}

int verp_core_close(verp_core core) {
  return call("verp_core_close", [&] { cores().take(core); });
}

int verp_core_reset(verp_core core) {
  return call("verp_core_reset", [&] { cores().use(core)->state = {}; });
}

int verp_core_step(verp_core core, const verp_inputs* inputs, verp_outputs* outputs) {
  return call("verp_core_step", [&] {
    need(inputs, "inputs");
    need(outputs, "outputs");
    const auto used = cores().use(core);
    const auto in = std::bit_cast<verp::Inputs>(*inputs);
    auto out = std::bit_cast<verp::Outputs>(*outputs);
    verp::step(used->params, used->state, in, out);
    *outputs = std::bit_cast<verp_outputs>(out);
  });
}

int verp_core_digest(verp_core core, uint64_t* digest) {
  return call("verp_core_digest", [&] {
    need(digest, "digest");
    *digest = cores().use(core)->state.digest.chain;
  });
}

int verp_core_state(verp_core core, void* state, uint64_t size) {
  return call("verp_core_state", [&] {
    need(state, "state");
    need_size(size, sizeof(verp::State), "state");
    std::memcpy(state, &cores().use(core)->state, sizeof(verp::State));
  });
}

int verp_core_params(verp_core core, void* params, uint64_t size) {
  return call("verp_core_params", [&] {
    need(params, "params");
    need_size(size, sizeof(verp::Params), "params");
    std::memcpy(params, &cores().use(core)->params, sizeof(verp::Params));
  });
}

int verp_core_joints(verp_core core, uint32_t* joints) {
  return call("verp_core_joints", [&] {
    need(joints, "joints");
    *joints = cores().use(core)->params.joint_count;
  });
}

int verp_core_period(verp_core core, double* period_s) {
  return call("verp_core_period", [&] {
    need(period_s, "period_s");
    *period_s = 1e-6 * cores().use(core)->params.period_us;
  });
}

int verp_core_joint_name(verp_core core, uint32_t joint, char* name, uint64_t size) {
  return call("verp_core_joint_name", [&] {
    need(name, "name");
    const auto used = cores().use(core);
    const char* text = joint_of(*used, joint).name;
    const std::size_t length = ::strnlen(text, verp::kNameLength);
    if (size <= length)
      throw Failure(VERP_BAD_ARGUMENT, "name has no room for " + std::to_string(length + 1));
    std::memcpy(name, text, length);
    name[length] = '\0';
  });
}

int verp_core_count(verp_core core, uint32_t joint, float angle_rad, int32_t* count) {
  return call("verp_core_count", [&] {
    need(count, "count");
    finite(angle_rad, "angle_rad");
    const auto used = cores().use(core);
    *count = verp::model::count_of(joint_of(*used, joint), angle_rad);
  });
}

int verp_core_angle(verp_core core, uint32_t joint, int32_t count, float* angle_rad) {
  return call("verp_core_angle", [&] {
    need(angle_rad, "angle_rad");
    const auto used = cores().use(core);
    *angle_rad = verp::model::angle_of(joint_of(*used, joint), count);
  });
}

int verp_core_forward(verp_core core, const float* angle_rad, uint32_t joints, float* poses) {
  return call("verp_core_forward", [&] {
    need(angle_rad, "angle_rad");
    need(poses, "poses");
    const auto used = cores().use(core);
    need_all_joints(*used, angle_rad, joints);
    verp::Pose node[verp::kMaxNodes];
    verp::kinematics::all_poses(used->params, verp::Pose(), angle_rad, node);
    for (std::uint32_t n = 0; n <= joints; ++n) put_pose(node[n], poses + VERP_POSE * n);
  });
}

int verp_core_com(verp_core core, const float* angle_rad, uint32_t joints, float* com_m) {
  return call("verp_core_com", [&] {
    need(angle_rad, "angle_rad");
    need(com_m, "com_m");
    const auto used = cores().use(core);
    need_all_joints(*used, angle_rad, joints);
    const verp::Vec3 com = verp::kinematics::center_of_mass(used->params, verp::Pose(), angle_rad);
    std::copy_n(com.data(), 3, com_m);
  });
}

int verp_core_leg_ik(verp_core core, uint32_t side, const float* sole, const float* before_rad,
                     float* angle_rad, uint32_t* flags) {
  return call("verp_core_leg_ik", [&] {
    need(sole, "sole");
    need(angle_rad, "angle_rad");
    need(flags, "flags");
    need_finite(sole, VERP_POSE, "sole");
    need_rotation(sole, "sole");
    if (before_rad != nullptr) need_finite(before_rad, VERP_LEG_JOINTS, "before_rad");
    const auto used = cores().use(core);
    const verp::LegParams& leg = leg_of(*used, side);
    float start_rad[verp::kLegJoints];
    for (int k = 0; k < verp::kLegJoints; ++k) {
      start_rad[k] = before_rad != nullptr ? before_rad[k]
                                           : verp::model::joint_of(used->params, leg, k).stand_rad;
    }
    const auto solved = verp::kinematics::solve_leg(used->params, leg, pose_from(sole), start_rad);
    std::copy_n(solved.angle_rad, verp::kLegJoints, angle_rad);
    *flags = solved.flags;
  });
}

int verp_core_leg_joints(verp_core core, uint32_t side, uint32_t* joint) {
  return call("verp_core_leg_joints", [&] {
    need(joint, "joint");
    const auto used = cores().use(core);
    std::copy_n(leg_of(*used, side).joint, verp::kLegJoints, joint);
  });
}

int verp_core_plan(verp_core core, double vx_m_s, double vy_m_s, double wz_rad_s, verp_plan* plan,
                   uint32_t count, uint32_t stop) {
  return call("verp_core_plan", [&] {
    if (count > VERP_MOST_PLANNED) {
      throw Failure(VERP_BAD_ARGUMENT, fmt::format("count is {}: at most {} ticks are planned",
                                                   count, +VERP_MOST_PLANNED));
    }
    if (count > 0) need(plan, "plan");
    if (stop > count) throw Failure(VERP_BAD_ARGUMENT, "stop is more than count");
    const verp::Command velocity = velocity_of(vx_m_s, vy_m_s, wz_rad_s);
    const auto used = cores().use(core);
    leg_of(*used, 0);
    plan_walk(used->params, velocity, plan, count, stop);
  });
}
