#pragma once
#include <cstdint>

#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::app {

/// What an answer is worth.
enum class Answer : std::uint8_t {
  kFresh,  ///< of this tick
  kOld,    ///< maybe of the tick before: it counts for nothing
  kAgain,  ///< its source has a fresh one in this tick: if they differ, one of the two is old
};

/// Which answers to a tick's SYNCs are still to come, and which of those that come are new. A
/// source is a node, or the IMU's second frame.
///
/// A node that missed a SYNC, or heard one twice, counts on from there (CiA 301), and answers
/// another one than it was told to for ever after. An answer later in the round than planned was
/// taken in this tick if its source's last one came in the tick before; else it may be that one.
/// One that is earlier may be late from the tick before. What comes so in some ticks in a row
/// counts, and is then waited for where it comes.
///
/// An answer that did not come may still be on its way, in a drive that could not get onto the bus
/// or in a slow gateway, and come when the next one is due, which then comes a tick late as well.
/// So what a source says counts no more, once it owes an answer, until the bus has shown that
/// nothing waits for it: prompt(). That is in the next tick, as a rule; one tick more where answers
/// have come late by themselves, as from a gateway, of which other frames show nothing.
class AnswerWatch {
 public:
  static constexpr int kImuSecond = kCanNodes;
  static constexpr int kSources = kCanNodes + 1;
  static constexpr int kMostGroups = kMaxJoints / canopen::plan::kAnswersToOneSync + 2;

  void plan(int source, std::uint8_t group) {
    planned_ |= node_bit(source);
    source_[source] = {group, group, 0, 0, 0};
  }
  /// Those who answer another SYNC than planned. In the long run too many answer the same one.
  NodeMask astray() const {
    NodeMask mask = 0;
    for (int i = 0; i < kSources; ++i) {
      mask |= source_[i].group != source_[i].planned ? node_bit(i) : 0;
    }
    return mask;
  }
  /// From now on it answers the one that was planned.
  void restore(int source) { source_[source].group = source_[source].planned; }

  /// A tick begins.
  void begin() {
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
  /// A drive's SDO answer that was asked for at the end of the last tick was there when this one
  /// began: on the wire, each PDO that was ready would have gone before it.
  void prompt() {
    owing_ = 0;
    if (prompt_times_ < kKnown) ++prompt_times_;
  }
  /// Nobody counts: the whole bus may be late.
  bool all_owe() const { return planned_ != 0 && (owing_ | owing_since_) == planned_; }

  /// An answer came after SYNC `window`.
  Answer take(int source, std::uint8_t window) {
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
  /// Two different answers of this source came in this tick: none counts any more.
  void spoil(int source) {
    tardy_ticks_ = kTardyTicks;
    fresh_ &= ~node_bit(source);
    spoilt_ |= node_bit(source);
  }
  /// An answer came when the tick was over, and counts for none; it may show that a node answers
  /// the last SYNC now, where nobody waited for it.
  void take_late(int source, std::uint8_t last_window) {
    Source& each = source_[source];
    if (each.group != last_window) move(each, last_window);
  }

  /// Who is to answer this SYNC and has not, or answered it in the last tick in place of another;
  /// those in `given_up` are not waited for.
  NodeMask due(std::uint8_t window, NodeMask given_up) const {
    NodeMask mask = 0;
    for (int i = 0; i < kSources; ++i) {
      const Source& each = source_[i];
      const bool again = each.times > 0 && each.heard == window;
      mask |= each.group == window || again ? node_bit(i) : 0;
    }
    return mask & planned_ & ~answered_ & ~given_up;
  }
  /// The group most of whose nodes answered SYNC `window` first in this tick, where most of those
  /// it is meant for did not; 0: none. A single node shows nothing.
  std::uint8_t group_in(std::uint8_t window) const {
    int meant = 0, came = 0;
    for (const Source& each : source_) {
      if (each.planned != window) continue;
      ++meant;
      came += each.came == window ? 1 : 0;
    }
    if (came * 2 > meant) return 0;
    return most(2, [&](int i) { return source_[i].came == window; });
  }
  /// Most of the nodes that SYNC `window` is meant for have been silent in this tick, and were
  /// well in the one before. Two answers may be lost each by itself.
  bool fell_silent(std::uint8_t window) const {
    return most(3, [&](int i) {
             return ((before_ & ~answered_) >> i & 1) != 0 && source_[i].planned == window;
           }) == window;
  }
  /// All nodes answer the SYNCs that were planned from now on.
  void realign() {
    for (Source& each : source_) {
      each.group = each.planned;
      each.times = 0;
    }
  }
  NodeMask planned() const { return planned_; }
  NodeMask answered() const { return answered_; }

 private:
  /// Twice, as its own place was empty between; once more where the bus as a whole may be late.
  static constexpr std::uint8_t kTicks = 2;
  static constexpr std::uint8_t kTicksUnknown = 3;
  /// A bus that was prompt so often is expected to be so again. Some drives never are.
  static constexpr std::uint8_t kKnown = 16;
  /// For so many ticks an answer that came late by itself is remembered.
  static constexpr std::uint16_t kTardyTicks = 1000;
  struct Source {
    std::uint8_t planned = 0;
    std::uint8_t group = 0;  ///< where it is waited for
    std::uint8_t heard = 0;  ///< the window in which it came last when it was another
    std::uint8_t times = 0;  ///< so many times in a row
    std::uint8_t came = 0;   ///< the window of this tick's first answer that nobody doubts; 0: none
  };
  /// The group of most of whose nodes, `least` or more, `holds` is true; 0: none.
  template <class Holds>
  std::uint8_t most(int least, Holds holds) const {
    std::uint8_t all[kMostGroups + 1] = {}, those[kMostGroups + 1] = {};
    std::uint8_t found = 0;
    for (int i = 0; i < kSources; ++i) {
      const std::uint8_t group = source_[i].planned;
      ++all[group];
      if (group != 0 && holds(i)) ++those[group];
    }
    for (std::uint8_t group = 1; group <= kMostGroups; ++group) {
      if (those[group] >= least && 2 * those[group] > all[group]) found = group;
    }
    return found;
  }
  /// True if it comes there from now on.
  bool move(Source& each, std::uint8_t window) const {
    each.times = each.heard == window ? static_cast<std::uint8_t>(each.times + 1) : std::uint8_t{1};
    each.heard = window;
    if (each.times < (prompt_times_ == kKnown ? kTicks : kTicksUnknown)) return false;
    each.group = window;
    each.times = 0;
    return true;
  }
  Source source_[kSources];
  NodeMask planned_ = 0;
  NodeMask answered_ = ~NodeMask{0};
  NodeMask fresh_ = ~NodeMask{0};
  NodeMask before_ = 0;  ///< whose answers were fresh in the tick before
  NodeMask spoilt_ = 0;
  NodeMask owing_ = 0;        ///< an answer that may still come
  NodeMask owing_since_ = 0;  ///< likewise, since the last tick, whatever other frames show
  std::uint16_t tardy_ticks_ = 0;
  std::uint8_t prompt_times_ = 0;
};

}  // namespace verp::app
