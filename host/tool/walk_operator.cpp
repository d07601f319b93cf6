#include "host/tool/walk_operator.hpp"

#include <algorithm>
#include <cmath>

#include "common/gait/types.hpp"
#include "common/safety/machine.hpp"

namespace verp::tool {
namespace {

constexpr double kSettle_s = 0.5;    // a person waits for the robot to stand quietly
constexpr double kStandUp_s = 15.0;  // bring-up pose, rise and gyro calibration take a few seconds
constexpr double kIdle_s = 1.0;      // a gait that pauses by itself this long has given up
constexpr double kOverrun_s = 5.0;   // a gait that has not ended by then never will
constexpr std::uint32_t kFrameTicks = 10;  // operator frames come at a tenth of the control rate

}  // namespace

WalkOperator::WalkOperator(const Params& params, const Command& velocity, double walk_s)
    : params_(params), velocity_(velocity), walk_s_(walk_s), period_s_(params.period_us * 1e-6) {
  command_.request = Request::kStand;
}

/// Steps already queued, strides that shrink, the step that closes the feet, and the final one.
double WalkOperator::stop_lead_s() const {
  const GaitTuning& gait = params_.tuning.gait;
  const double step_s = 0.5 * static_cast<double>(gait.cycle_s);
  const double stride_m =
      1e-4 * std::hypot(velocity_.vx_tenth_mm_s, velocity_.vy_tenth_mm_s) * step_s;
  const double shrinking = std::ceil(stride_m / static_cast<double>(gait.step_change_m));
  constexpr double kQueuedAndClosing = gait::kQueue + 1;
  return (kQueuedAndClosing + shrinking) * step_s + static_cast<double>(gait.start_s);
}

app::OperatorOrder WalkOperator::order(std::uint32_t tick) {
  app::OperatorOrder order;
  if (tick % kFrameTicks == 0) {
    ++command_.sequence;
    order.flags = kCommandFresh;
  }
  order.command = command_;
  return order;
}

void WalkOperator::observe(std::uint32_t, const Outputs& outputs) {
  const bool gait = outputs.gait_phase != static_cast<std::uint8_t>(gait::Phase::kIdle);
  const bool standing = outputs.mode == static_cast<std::uint8_t>(safety::Mode::kStanding);
  if (gait) {
    gait_seen_ = true;
    walked_s_ += period_s_;
    idle_s_ = 0;
  } else if (!gait_seen_) {
    waited_s_ += period_s_;
    stood_s_ = standing ? stood_s_ + period_s_ : 0;
  }
  if (!gait_seen_ && stood_s_ >= kSettle_s) {
    const std::uint8_t sequence = command_.sequence;
    command_ = velocity_;
    command_.sequence = sequence;
    command_.request = Request::kWalk;
  }
  if (gait_seen_ && !stopping_ && walked_s_ + stop_lead_s() >= walk_s_) {
    stopping_ = true;
    command_.request = Request::kStand;
  }
  if (gait_seen_ && !stopping_ && !gait) idle_s_ += period_s_;
  if (idle_s_ > kIdle_s) failed_ = "the robot stopped walking by itself", done_ = true;
  if (stopping_) stopping_s_ += period_s_;
  if (stopping_ && !gait && standing) done_ = true;
  if (!gait_seen_ && waited_s_ > kStandUp_s)
    failed_ = "the robot did not start to walk", done_ = true;
  if (stopping_s_ > stop_lead_s() + kOverrun_s) failed_ = "the gait did not end", done_ = true;
}

}  // namespace verp::tool
