#include "common/control/step.hpp"

namespace verp {

void step(const Params& params, State& state, const Inputs& inputs, Outputs& outputs) noexcept {
  if (state.started == 0) state.tuning = params.tuning;
  state.started = 1;
  outputs = Outputs{};
  record::Digest32 digest(inputs.tick);
  digest.add_struct(inputs);
  state.digest.stage[0] = digest.value();
  state.digest.chain = record::chain(state.digest.chain, digest.value());
}

}  // namespace verp
