#pragma once
#include <cstdint>
#include <limits>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/counts.hpp"
#include "common/model/params.hpp"
#include "common/record/digest.hpp"

namespace verp::app {

/// A user's controller in the core's place, on a board as on the PC. Each tick calls `Controller`
/// with Params, the core's State, Inputs and the previous Outputs; its other memory is its own.
///
/// A goal outside its joint's range (also NaN) is not sent: the joint keeps its previous goal, or
/// stays limp. The digest covers what is sent.
template <class Controller>
class OwnLaw {
 public:
  void operator()(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
    const Outputs before = outputs;
    controller_(params, state, inputs, outputs);
    refused_ = kNone;
    for (int joint = params.joint_count - 1; joint >= 0; --joint) {
      if (is_sound(params.joint[joint], joint, outputs)) continue;
      refused_ = joint;
      refused_count_ = outputs.goal_count[joint];
      outputs.goal_count[joint] = before.goal_count[joint];
      // A limp joint stays limp.
      const std::uint32_t bit = 1U << joint;
      if ((before.torque_enable & bit) == 0) outputs.torque_enable &= ~bit;
    }
    record::Digest32 digest(0);
    digest.add_struct(outputs);
    state.digest.chain = record::chain(state.digest.chain, digest.value());
  }

  static constexpr int kNone = -1;
  /// The first joint whose goal was refused in the last tick, and that goal.
  int refused() const { return refused_; }
  std::int32_t refused_count() const { return refused_count_; }

 private:
  /// Margin beyond the range: as much as the core's own goals use against sag.
  static constexpr float kSlack_rad = 0.1F;

  static bool is_sound(const JointParams& joint, int index, const Outputs& outputs) {
    if ((outputs.torque_enable >> index & 1U) == 0) return true;
    const float rad = model::angle_of(joint, outputs.goal_count[index]);
    return rad >= joint.lower_rad - kSlack_rad && rad <= joint.upper_rad + kSlack_rad;
  }

  Controller controller_;
  int refused_ = kNone;
  std::int32_t refused_count_ = 0;
};

/// A goal in counts. OwnLaw refuses that of a NaN.
inline std::int32_t goal_of(const JointParams& joint, float rad) {
  return rad == rad ? model::count_of(joint, rad) : std::numeric_limits<std::int32_t>::min();
}

}  // namespace verp::app
