#include "host/apps/view/run/step_on.hpp"

#include <bit>

#include "common/control/step.hpp"

namespace verp::view {

StepOn::StepOn(const scene::TracePlayer& player, std::size_t index)
    : player_(player), index_(index) {
  player_.controller_at(index_, state_, outputs_);
}

void StepOn::on(int ticks) {
  for (int i = 0; i < ticks && !ended(); ++i) {
    Inputs seen = player_.trace().ticks[++index_].inputs;
    // Recorded writes come first, one a tick.
    if (!writes_.empty() && (seen.flags & kParameterWrite) == 0) {
      seen.flags |= kParameterWrite;
      seen.parameter_id = static_cast<std::uint16_t>(writes_.front().first);
      seen.parameter_bits = std::bit_cast<std::uint32_t>(writes_.front().second);
      writes_.pop_front();
    }
    step(player_.trace().params, state_, seen, outputs_);
  }
}

bool StepOn::same_bits() const {
  return state_.digest.chain == player_.trace().ticks[index_].digest.chain;
}

}  // namespace verp::view
