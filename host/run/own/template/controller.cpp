#include "controller.hpp"

#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"
#include "common/model/counts.hpp"
#include "common/safety/machine.hpp"
#include "firmware/law/own_law.hpp"

namespace {

/// -1: this robot has no such joint.
int joint_named(const verp::Params& params, const char* name) {
  for (int j = 0; j < params.joint_count; ++j) {
    if (__builtin_strcmp(params.joint[j].name, name) == 0) return j;
  }
  return -1;
}

/// Adds to a goal, within the joint's range.
void turn(const verp::Params& params, const char* name, float by_rad, verp::Outputs& out) {
  const int j = joint_named(params, name);
  if (j < 0) return;
  const verp::JointParams& joint = params.joint[j];
  const float rad = verp::model::angle_of(joint, out.goal_count[j]) + by_rad;
  out.goal_count[j] =
      verp::app::goal_of(joint, verp::math::clamp(rad, joint.lower_rad, joint.upper_rad));
}

}  // namespace

void Controller::operator()(const verp::Params& params, const verp::State&, const verp::Inputs&,
                            verp::Outputs& out) {
  constexpr float kRaised_s = 1, kWaves_rad_s = 9, kRaise_rad = -2.6F, kWave_rad = 0.3F;
  const auto mode = static_cast<verp::safety::Mode>(out.mode);
  const bool stands = mode == verp::safety::Mode::kStanding || mode == verp::safety::Mode::kWalking;
  const float period_s = 1e-6F * static_cast<float>(params.period_us);
  const float by = (stands ? period_s : -period_s) / kRaised_s;
  up = verp::math::clamp(up + by, 0.0F, 1.0F);
  if (out.torque_enable == 0) up = 0;  // limp: the joints stay where they are
  if (up <= 0) return;
  waved_rad += kWaves_rad_s * period_s;
  turn(params, "r_shoulder_pitch", kRaise_rad * up, out);
  turn(params, "r_shoulder_roll", kWave_rad * up * (verp::math::sin(waved_rad) - 1), out);
}
