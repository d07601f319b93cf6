#include "firmware/app/answer_watch.hpp"

namespace verp::app {

void AnswerWatch::plan(int source, std::uint8_t group) {
  planned_ |= node_bit(source);
  source_[source] = {group, group, 0, 0, 0};
}

NodeMask AnswerWatch::astray() const {
  NodeMask mask = 0;
  for (int i = 0; i < kSources; ++i) {
    mask |= source_[i].group != source_[i].planned ? node_bit(i) : 0;
  }
  return mask;
}

void AnswerWatch::begin() {
  const NodeMask missed = prompt_times_ == kKnown ? planned_ & ~answered_ : 0;
  const bool tardy = tardy_ticks_ > 0;
  if (tardy) --tardy_ticks_;
  owing_ |= owing_since_ | (tardy ? 0 : missed);
  owing_since_ = tardy ? missed : 0;
  for (int i = 0; i < kSources; ++i) {
    if ((answered_ & node_bit(i)) == 0) source_[i].times = 0;
    source_[i].came = 0;
  }
  before_ = fresh_;
  answered_ = fresh_ = spoilt_ = 0;
}

void AnswerWatch::prompt() {
  owing_ = 0;
  if (prompt_times_ < kKnown) ++prompt_times_;
}

Answer AnswerWatch::take(int source, std::uint8_t window) {
  Source& each = source_[source];
  const NodeMask bit = node_bit(source);
  const bool first = (answered_ & bit) == 0;
  answered_ |= bit;
  if (((owing_ | owing_since_ | spoilt_) & bit) != 0) return Answer::kOld;
  if (first) each.came = window;
  if ((fresh_ & bit) != 0) return Answer::kAgain;
  const bool planned = window == each.group;
  if (planned) each.times = 0;
  const bool later = window > each.group && (before_ & bit) != 0;
  if (!planned && !move(each, window) && !later) return Answer::kOld;
  fresh_ |= bit;
  return Answer::kFresh;
}

void AnswerWatch::spoil(int source) {
  tardy_ticks_ = kTardyTicks;
  fresh_ &= ~node_bit(source);
  spoilt_ |= node_bit(source);
}

void AnswerWatch::take_late(int source, std::uint8_t last_window) {
  Source& each = source_[source];
  if (each.group != last_window) move(each, last_window);
}

NodeMask AnswerWatch::due(std::uint8_t window, NodeMask given_up) const {
  NodeMask mask = 0;
  for (int i = 0; i < kSources; ++i) {
    const Source& each = source_[i];
    const bool again = each.times > 0 && each.heard == window;
    mask |= each.group == window || again ? node_bit(i) : 0;
  }
  return mask & planned_ & ~answered_ & ~given_up;
}

std::uint8_t AnswerWatch::group_in(std::uint8_t window) const {
  int meant = 0, came = 0;
  for (const Source& each : source_) {
    if (each.planned != window) continue;
    ++meant;
    came += each.came == window ? 1 : 0;
  }
  if (came * 2 > meant) return 0;
  return most(2, [&](int i) { return source_[i].came == window; });
}

bool AnswerWatch::fell_silent(std::uint8_t window) const {
  return most(3, [&](int i) {
           return ((before_ & ~answered_) >> i & 1) != 0 && source_[i].planned == window;
         }) == window;
}

void AnswerWatch::realign() {
  for (Source& each : source_) {
    each.group = each.planned;
    each.times = 0;
  }
}

bool AnswerWatch::move(Source& each, std::uint8_t window) const {
  each.times = each.heard == window ? static_cast<std::uint8_t>(each.times + 1) : std::uint8_t{1};
  each.heard = window;
  if (each.times < (prompt_times_ == kKnown ? kTicks : kTicksUnknown)) return false;
  each.group = window;
  each.times = 0;
  return true;
}

}  // namespace verp::app
