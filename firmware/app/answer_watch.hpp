#pragma once
#include <cstdint>

#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::app {

enum class Answer : std::uint8_t {
  kFresh,  ///< of this tick
  kOld,    ///< maybe of the previous tick; ignored
  kAgain,  ///< a second one in this tick; if they differ, one is old
};

/// Decides which answers to a tick's SYNCs are still due and which received ones are fresh. A
/// source is a node, or the IMU's second frame.
///
/// A node that missed a SYNC or received one twice answers another SYNC ever after, because it
/// counts SYNCs (CiA 301). A late answer is fresh if the source was fresh in the previous tick;
/// otherwise it may be that tick's. An early one may be late from the previous tick. A shift that
/// repeats for some ticks becomes the source's new place.
///
/// A missing answer may still come when the next one is due: a drive could not get onto the bus, or
/// a gateway is slow. Every later answer is then a tick late. So a source that owes an answer does
/// not count until prompt() shows that nothing waits for the bus; where answers came late, one tick
/// longer.
class AnswerWatch {
 public:
  static constexpr int kImuSecond = kCanNodes;
  static constexpr int kSources = kCanNodes + 1;
  static constexpr int kMostGroups = kMaxJoints / canopen::plan::kAnswersToOneSync + 2;

  void plan(int source, std::uint8_t group);
  /// Sources that answer another SYNC than planned.
  NodeMask astray() const;
  void restore(int source) { source_[source].group = source_[source].planned; }

  void begin();
  /// Call when a drive's SDO answer, requested at the end of the last tick, was there when this
  /// tick began: a ready PDO would have preceded it on the wire.
  void prompt();
  /// True if no source counts: the whole bus may be late.
  bool all_owe() const { return planned_ != 0 && (owing_ | owing_since_) == planned_; }

  /// Rates an answer that came after SYNC `window`.
  Answer take(int source, std::uint8_t window);
  /// Two answers of this source in this tick differ: neither counts.
  void spoil(int source);
  /// An answer after the tick does not count, but may show that the node now answers the last SYNC.
  void take_late(int source, std::uint8_t last_window);

  /// Sources that should answer this SYNC, or did in the last tick, and have not yet. Excludes
  /// `given_up`.
  NodeMask due(std::uint8_t window, NodeMask given_up) const;
  /// The group most of whose nodes answered SYNC `window` first, while most planned for it did not;
  /// 0: none. A single node proves nothing.
  std::uint8_t group_in(std::uint8_t window) const;
  /// True if most nodes planned for SYNC `window` answered in the previous tick, not in this. Two
  /// lost answers may be coincidence.
  bool fell_silent(std::uint8_t window) const;
  /// All nodes answer their planned SYNCs from now on.
  void realign();
  NodeMask planned() const { return planned_; }
  NodeMask answered() const { return answered_; }

 private:
  /// Ticks until a shift counts; three while the whole bus may be late.
  static constexpr std::uint8_t kTicks = 2;
  static constexpr std::uint8_t kTicksUnknown = 3;
  /// Prompt ticks after which the bus is expected to stay prompt.
  static constexpr std::uint8_t kKnown = 16;
  /// A late answer is remembered this long.
  static constexpr std::uint16_t kTardyTicks = 1000;
  struct Source {
    std::uint8_t planned = 0;
    std::uint8_t group = 0;  ///< where its answer is expected
    std::uint8_t heard = 0;  ///< last window other than `group`
    std::uint8_t times = 0;  ///< ticks in a row in `heard`
    std::uint8_t came = 0;   ///< window of the first undoubted answer; 0: none
  };
  /// The group in which `holds` is true for most nodes, at least `least`; 0: none.
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
  /// True: the answer is expected in `window` from now on.
  bool move(Source& each, std::uint8_t window) const;
  Source source_[kSources];
  NodeMask planned_ = 0;
  NodeMask answered_ = ~NodeMask{0};
  NodeMask fresh_ = ~NodeMask{0};
  NodeMask before_ = 0;
  NodeMask spoilt_ = 0;
  NodeMask owing_ = 0;        ///< owe an answer that may still come
  NodeMask owing_since_ = 0;  ///< the same since the last tick, whatever other frames show
  std::uint16_t tardy_ticks_ = 0;
  std::uint8_t prompt_times_ = 0;
};

}  // namespace verp::app
