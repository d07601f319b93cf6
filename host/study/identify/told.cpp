#include <algorithm>
#include <cmath>

#include "host/study/identify/fit.hpp"

namespace verp::identify {
namespace {

constexpr double kTold = 0.2;  ///< relative error of a determined number
/// A quarter of a physics step; in slow stick-slip motion the computed error is too small: 400 us
/// for a delay that was wrong by 1,800.
constexpr double kToldDelay_us = 250;

}  // namespace

void Fit::leave_what_is_not_told(Estimate& estimate, std::size_t ticks) {
  const Estimate before = start();
  for (;;) {
    std::size_t worst = estimate.value.size();
    double most = 1;
    for (std::size_t i = 0; i < estimate.value.size(); ++i) {
      if (!estimate.free[i]) continue;
      const double limit =
          i == delay() ? kToldDelay_us : kTold * std::max(std::abs(estimate.value[i]), 1e-12);
      if (estimate.error[i] <= most * limit) continue;
      most = estimate.error[i] / limit;
      worst = i;
    }
    if (worst == estimate.value.size() || stopped_) return;
    estimate.free[worst] = false;
    estimate.value[worst] = before.value[worst];
    estimate.error[worst] = 0;
    improve(estimate, ticks, 1);
  }
}

}  // namespace verp::identify
