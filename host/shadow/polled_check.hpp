#pragma once
#include <cstdint>
#include <string>

#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "host/shadow/comparison.hpp"
#include "host/shadow/tick_port.hpp"

namespace verp::shadow {

/// A controller once more, beside one at the end of a serial link that is not its servo bus. The
/// controller keeps the records of its last ticks (firmware/app/tick_log.hpp); this PC fetches them
/// at its own pace, one by one, steps on with their Inputs and compares. The controller never waits
/// for it: ticks that it has dropped before they were fetched are counted as a gap, and its State
/// is read anew.
class PolledCheck {
 public:
  enum class State { kAsking, kFollowing, kDiffers, kRefused };

  /// `params` and `port` outlive it.
  PolledCheck(const Params& params, TickPort& port) : params_(params), port_(port) {}
  PolledCheck(const PolledCheck&) = delete;
  PolledCheck& operator=(const PolledCheck&) = delete;

  /// One request, or a few; false if there is nothing new, or nobody answers.
  bool turn(std::uint64_t now_us);

  // As LiveCheck's.
  State state() const { return state_; }
  bool over() const { return state_ == State::kDiffers || state_ == State::kRefused; }
  bool differs() const { return state_ == State::kDiffers; }
  bool suspects() const { return false; }
  std::uint64_t unsettled() const { return unsettled_; }
  std::uint64_t compared() const { return compared_; }
  std::uint64_t gaps() const { return gaps_; }
  std::uint64_t boots() const { return boots_; }
  std::uint32_t tick() const { return shadow_.admit.tick; }
  std::uint64_t digest() const { return shadow_.digest.chain; }
  std::uint64_t heard_us() const { return heard_us_; }
  const record::Divergence& divergence() const { return divergence_; }
  const std::string& refusal() const { return refusal_; }
  const std::string& gap() const { return gap_; }

 private:
  static constexpr std::size_t kTicks = app::TickLog<>::kTicks;
  static constexpr int kMostMisheard = 3;
  static constexpr int kClean = 1000;

  bool good(TickPort::Answer answer);
  bool begin();
  bool hold(app::TickLog<>::Hold what);
  bool read_state();
  bool read_ticks();
  bool follow();
  bool compare(const TickRecord& record);
  bool settle(const TickRecord& record);
  void lose(const std::string& why);
  void refuse(const std::string& why);

  const Params& params_;
  TickPort& port_;
  State state_ = State::kAsking;
  verp::State shadow_;
  std::uint32_t next_ = 0;  ///< tick
  Testimony testimony_;
  record::Divergence divergence_;
  std::string refusal_, gap_;
  std::uint64_t compared_ = 0, gaps_ = 0, boots_ = 0, heard_us_ = 0, now_us_ = 0, unsettled_ = 0;
  int misheard_ = 0;
  int clean_ = 0;
};

}  // namespace verp::shadow
