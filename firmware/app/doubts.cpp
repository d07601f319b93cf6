#include "firmware/app/doubts.hpp"

namespace verp::app {

void Doubts::silent_for(int joint, std::uint32_t time_us) {
  if (time_us < patience_us_) return;
  doubted_ |= 1u << joint;
  here_ &= ~(1u << joint);
}

bool Doubts::counts(int joint, bool alert) {
  if (!alert) broken_ &= ~(1u << joint);
  here_ |= doubted_ & ~broken_ & 1u << joint;
  return (doubted_ >> joint & 1) == 0;
}

void Doubts::shut_down(int joint) {
  doubted_ |= 1u << joint;
  broken_ |= 1u << joint;
  here_ &= ~(1u << joint);
}

std::uint32_t Doubts::open(bool torque) {
  if (!torque) limp_ = 0;
  return here_ & ~limp_;
}

std::uint32_t Doubts::some(std::uint32_t joints) const {
  std::uint32_t chosen = 0;
  std::size_t count = 0;
  for (int j = 0; j < params_.servo_count() && count < kResolvedAtOnce; ++j) {
    if ((joints >> j & 1) == 0) continue;
    chosen |= 1u << j;
    ++count;
  }
  return chosen;
}

void Doubts::learn(int joint, bool kept) {
  const std::uint32_t bit = 1u << joint;
  if (kept) trust(bit);
  if (!kept) limp_ |= bit;
}

void Doubts::trust(std::uint32_t joints) {
  doubted_ &= ~joints;
  here_ &= ~joints;
}

}  // namespace verp::app
