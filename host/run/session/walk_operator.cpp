#include "host/run/session/walk_operator.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/gait/footsteps.hpp"
#include "host/run/session/fault_names.hpp"

namespace verp::session {
namespace {

constexpr double kSettle_s = 0.5;          // stands quietly before the walk
constexpr double kStandUp_s = 15.0;        // pose, rise and gyro calibration take seconds
constexpr double kLearns_s = 2.0;          // by then a core has begun to learn its gyro's bias
constexpr double kPatience_s = 8.0;        // then the robot trembles, and the bias will not improve
constexpr double kIdle_s = 1.0;            // a gait that pauses so long by itself has given up
constexpr double kOverrun_s = 5.0;         // a gait that has not ended by then never ends
constexpr std::uint32_t kFrameTicks = 10;  // longest interval of the operator's frames
constexpr float kSomeError_rad = 1e-3F;    // a heading is never exact
constexpr int kMostSteps = 1000;           // by then any stride has shrunk to nothing

}  // namespace

WalkOperator::WalkOperator(const Params& params, const Command& velocity, double walk_s,
                           int get_ups, bool stands)
    : params_(params),
      velocity_(velocity),
      walk_s_(walk_s),
      period_s_(params.period_us * 1e-6),
      get_up_(get_ups, get_ups > 0),
      stands_(stands) {
  command_.request = get_ups > 0 ? Request::kGetUp : Request::kStand;
}

/// True while the robot is down and gets no other order. Each attempt is a new order.
bool WalkOperator::look_after_fall(safety::Mode mode) {
  switch (get_up_.observe(mode, period_s_)) {
    case GetUp::Phase::kUp:
      return false;
    case GetUp::Phase::kFell:
      changed_ = true;
      command_.request = Request::kGetUp;
      gait_seen_ = false;
      waited_s_ = standing_s_ = stood_s_ = idle_s_ = stopping_s_ = 0;
      return true;
    case GetUp::Phase::kDown:
      return true;
    case GetUp::Phase::kGaveUp:
      break;
  }
  failed_ = "the robot did not get up", done_ = true;
  command_.request = Request::kRelax;
  return changed_ = true;
}

/// Remaining gait if the stop is ordered now, or after one more step. Planned as the gait will:
/// queued steps, shrinking strides, closing step, final step.
double WalkOperator::lead_s(const State& state, bool one_more) const {
  const GaitTuning& tuning = state.tuning.gait;
  const gait::GaitState& gait = state.gait;
  gait::FootstepState footsteps = gait.footsteps;
  gait::VelocityIn wanted;
  wanted.vx_m_s = 1e-4F * static_cast<float>(velocity_.vx_tenth_mm_s);
  wanted.vy_m_s = 1e-4F * static_cast<float>(velocity_.vy_tenth_mm_s);
  wanted.wz_rad_s = 1e-3F * static_cast<float>(velocity_.wz_mrad_s);
  wanted.heading_error_rad = kSomeError_rad;
  // Outputs lag the gait's clock by look_ahead_s.
  std::int32_t rest_us =
      -std::max(gait.clock_us, static_cast<std::int32_t>(1e6F * tuning.look_ahead_s));
  for (int i = 0; i < gait.queued; ++i) rest_us += gait.queue[i].duration_us();
  gait::Step last = gait.queue[gait.queued - 1];
  wanted.stop = !one_more;
  for (int i = 0; i < kMostSteps && !last.ends_walk(); ++i) {
    last = gait::next_step(params_, tuning, wanted, last, footsteps);
    rest_us += last.duration_us();
    wanted.stop = true;
  }
  return 1e-6 * rest_us;
}

void WalkOperator::stop_in_time(const State& state) {
  if (state.gait.queued == 0 || state.gait.queue[state.gait.queued - 1].ends_walk()) return;
  if (walked_s_ + lead_s(state, true) <= walk_s_) {
    could_walk_on_ = true;
    return;
  }
  stopping_ = true;
  changed_ = true;
  command_.request = Request::kStand;
  lead_s_ = lead_s(state, false);
  longer_than_asked_ = !could_walk_on_ && walked_s_ + lead_s_ > walk_s_ + period_s_;
}

app::OperatorOrder WalkOperator::order(std::uint32_t tick) {
  app::OperatorOrder order;
  if (tick % kFrameTicks == 0 || changed_) {
    ++command_.sequence;
    order.flags = kCommandFresh;
  }
  changed_ = false;
  order.command = command_;
  return order;
}

void WalkOperator::observe(const State& state, const Outputs& outputs) {
  if (done_ || look_after_fall(static_cast<safety::Mode>(outputs.mode))) return;
  const bool standing = outputs.mode == static_cast<std::uint8_t>(safety::Mode::kStanding);
  // It fell while stopping: the walk is over.
  if (stopping_ && !gait_seen_ && standing) {
    done_ = true;
    return;
  }
  // Steps after a push do not count as the walk.
  if (!gait_seen_ && command_.request != Request::kWalk && stood_s_ < kSettle_s) {
    wait_for_stand(state, outputs, standing);
  } else if (stands_) {
    watch_stand(standing);
  } else {
    watch_walk(state, outputs, standing);
  }
}

/// A robot must know its gyro bias before a push. Before a walk, two more seconds halve its heading
/// error. A user's controller may never learn it.
bool WalkOperator::knows_gyro(float still_s) const {
  if (stands_) return still_s >= balance::kCalibrated_s;
  const bool learns = still_s > 0 || standing_s_ < kLearns_s;
  return !learns || still_s >= balance::kBestKnown_s || standing_s_ > kPatience_s;
}

void WalkOperator::wait_for_stand(const State& state, const Outputs& outputs, bool standing) {
  waited_s_ += period_s_;
  standing_s_ = standing ? standing_s_ + period_s_ : 0;
  stood_s_ = standing && knows_gyro(state.attitude.still_s) ? stood_s_ + period_s_ : 0;
  if (waited_s_ > kStandUp_s) {
    failed_ = stands_ ? "the robot did not stand: " : "the robot did not start to walk: ";
    failed_ += standing ? "it is not still enough to learn its gyro's bias"
                        : fmt::format("after {:g} s it is {}, not standing", kStandUp_s,
                                      safety::kModeNames[outputs.mode % safety::kModes]);
    done_ = true;
  }
  if (stood_s_ < kSettle_s) return;
  changed_ = true;
  const std::uint8_t sequence = command_.sequence;
  command_ = stands_ ? Command{} : velocity_;
  command_.sequence = sequence;
  command_.request = stands_ ? Request::kStand : Request::kWalk;
}

void WalkOperator::watch_stand(bool standing) {
  walked_s_ += period_s_;
  if (walked_s_ >= walk_s_ && standing) done_ = true;
  if (walked_s_ > walk_s_ + kOverrun_s)
    failed_ = "the robot did not come to stand again", done_ = true;
}

void WalkOperator::watch_walk(const State& state, const Outputs& outputs, bool standing) {
  const bool gait = state.gait.queued > 0;
  if (outputs.gait_phase != static_cast<std::uint8_t>(gait::Phase::kIdle)) walked_s_ += period_s_;
  if (gait) {
    gait_seen_ = true;
    idle_s_ = 0;
  } else if (!gait_seen_) {
    waited_s_ += period_s_;
  }
  if (!stopping_) stop_in_time(state);
  if (gait_seen_ && !stopping_ && !gait) idle_s_ += period_s_;
  if (idle_s_ > kIdle_s) failed_ = "the robot stopped walking by itself", done_ = true;
  if (stopping_) stopping_s_ += period_s_;
  if (stopping_ && !gait && standing) done_ = true;
  if (!gait_seen_ && waited_s_ > kStandUp_s) {
    const std::string notes = fault_names(outputs.faults);
    failed_ = "the robot did not start to walk: no gait began" +
              (notes.empty() ? std::string() : ", and its controller noted: " + notes);
    done_ = true;
  }
  if (stopping_s_ > lead_s_ + kOverrun_s) failed_ = "the gait did not end", done_ = true;
}

}  // namespace verp::session
