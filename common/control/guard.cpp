#include "common/control/guard.hpp"

#include "common/math/scalar.hpp"
#include "common/model/coupling.hpp"
#include "common/safety/machine.hpp"

namespace verp::control {
namespace {

using safety::Mode;

bool in_range(const JointParams& joint, std::int32_t goal_count) {
  const float rad = model::angle_of(joint, goal_count);
  return rad >= joint.lower_rad - kGoalSlack_rad && rad <= joint.upper_rad + kGoalSlack_rad;
}

/// As far towards `to` as the joint may move in one tick.
std::int32_t toward(const JointParams& joint, float period_s, std::int32_t from, std::int32_t to) {
  const float from_rad = model::angle_of(joint, from);
  const float way_rad = model::angle_of(joint, to) - from_rad;
  const float most_rad = joint.velocity_limit_rad_s * period_s;
  if (way_rad <= most_rad && way_rad >= -most_rad) return to;
  return model::count_of(joint, from_rad + math::copysign(most_rad, way_rad));
}

}  // namespace

int guard(const Params& params, const Inputs& inputs, const Outputs& sent, const Outputs& core,
          Outputs& asked) {
  const Outputs theirs = asked;
  asked = core;
  const auto mode = static_cast<Mode>(core.mode);
  const bool heard = mode == Mode::kStanding || mode == Mode::kWalking;
  asked.torque_enable &= theirs.torque_enable;
  const float period_s = static_cast<float>(params.period_us) * 1e-6F;
  int refused = kMaxJoints;
  for (int j = params.servo_count() - 1; j >= 0; --j) {
    const JointParams& joint = params.joint[j];
    const std::uint32_t bit = 1U << j;
    if ((asked.torque_enable & bit) == 0) continue;
    const bool held = (sent.torque_enable & bit) != 0;
    const std::int32_t from = held ? sent.goal_count[j] : inputs.position_count[j];
    if (heard && !in_range(joint, theirs.goal_count[j])) {
      refused = j;
      asked.goal_count[j] = from;
      if (!held) asked.torque_enable &= ~bit;
      continue;
    }
    const bool frozen = mode == Mode::kHolding && held;
    const std::int32_t to = heard ? theirs.goal_count[j] : core.goal_count[j];
    asked.goal_count[j] = frozen ? from : toward(joint, period_s, from, to);
  }
  for (int j = params.servo_count(); j < params.joint_count; ++j) {
    asked.goal_count[j] = asked.goal_count[model::driver_of(params, j)];
  }
  return refused;
}

}  // namespace verp::control
