#pragma once
#include <cstdint>
#include <limits>

#include "common/control/guard.hpp"
#include "common/control/step.hpp"
#include "common/model/counts.hpp"
#include "common/record/digest.hpp"

namespace verp::app {

/// A user's controller, on a board as on the PC. In each tick the core's step() decides first; then
/// `Controller` changes the goals. Last, control::guard() decides what is sent, so no controller
/// keeps torque through an emergency stop. The digest covers what is sent.
template <class Controller>
class OwnLaw {
 public:
  void operator()(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) {
    state.trust.foreign = 1;
    step(params, state, inputs, outputs);
    const Outputs core = outputs;
    controller_(params, static_cast<const State&>(state), inputs, outputs);
    asked_ = outputs;
    refused_ = control::guard(params, inputs, sent_, core, outputs);
    sent_ = outputs;
    record::Digest32 digest(0);
    digest.add_struct(outputs);
    state.digest.chain = record::chain(state.digest.chain, digest.value());
  }

  static constexpr int kNone = -1;
  /// The first joint whose goal was refused in the last tick, and that goal.
  int refused() const { return refused_ < kMaxJoints ? refused_ : kNone; }
  std::int32_t refused_count() const { return asked_.goal_count[refused_ % kMaxJoints]; }

 private:
  Controller controller_;
  Outputs asked_, sent_;
  int refused_ = kMaxJoints;
};

/// A goal in counts. OwnLaw refuses that of a NaN.
inline std::int32_t goal_of(const JointParams& joint, float rad) {
  return rad == rad ? model::count_of(joint, rad) : std::numeric_limits<std::int32_t>::min();
}

}  // namespace verp::app
