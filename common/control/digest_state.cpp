#include "common/control/digest_state.hpp"

namespace verp {
namespace {

template <class... Parts>
std::uint32_t digest_of(Stage stage, const Parts&... parts) {
  record::Digest32 digest(static_cast<std::uint32_t>(stage) + 1U);
  (digest.add_struct(parts), ...);
  return digest.value();
}

}  // namespace

void digest_state(const Inputs& inputs, const Outputs& outputs, State& state) {
  TickDigest& digest = state.digest;
  const auto set = [&](Stage stage, std::uint32_t value) {
    digest.stage[static_cast<int>(stage)] = value;
    digest.chain = record::chain(digest.chain, value);
  };
  set(Stage::kAdmit, digest_of(Stage::kAdmit, inputs, state.tuning, state.trust, state.admit));
  set(Stage::kEstimate, digest_of(Stage::kEstimate, state.attitude, state.estimator, state.steer));
  // Skipped while all zero.
  const bool acts = state.action.number != 0 || state.action.asked != 0;
  set(Stage::kPlan, acts ? digest_of(Stage::kPlan, state.gait, state.action)
                         : digest_of(Stage::kPlan, state.gait));
  set(Stage::kBalance, digest_of(Stage::kBalance, state.stepping, state.feedback));
  set(Stage::kKinematics, digest_of(Stage::kKinematics, state.zeros, state.landing));
  set(Stage::kLimit, digest_of(Stage::kLimit, state.limit));
  set(Stage::kGate, digest_of(Stage::kGate, state.machine, outputs));
}

}  // namespace verp
