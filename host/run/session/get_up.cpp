#include "host/run/session/get_up.hpp"

#include <utility>

namespace verp::session {
namespace {

constexpr double kDown_s = 60;  // all attempts; each takes less than 20 s

}  // namespace

GetUp::Phase GetUp::observe(safety::Mode mode, double period_s) {
  using safety::Mode;
  const Mode before = std::exchange(mode_, mode);
  if (most_ == 0) return Phase::kUp;
  const bool fell = mode != before && (mode == Mode::kFalling || mode == Mode::kFallen);
  if (fell && !down_) tries_ = 0, down_s_ = 0;
  down_ = down_ || fell;
  if (mode != before && mode == Mode::kGettingUp) ++tries_;
  if (!down_) return Phase::kUp;
  if (mode == Mode::kStanding) {
    down_ = false;
    return Phase::kUp;
  }
  down_s_ += period_s;
  down_ = !(mode == Mode::kFallen && tries_ >= most_) && down_s_ <= kDown_s;
  if (!down_) return Phase::kGaveUp;
  return fell ? Phase::kFell : Phase::kDown;
}

}  // namespace verp::session
