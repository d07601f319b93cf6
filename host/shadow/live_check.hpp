#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "host/shadow/comparison.hpp"
#include "host/shadow/tick_listener.hpp"

namespace verp::shadow {

/// A controller once more, beside the one on a CAN bus. As soon as it hears of a tick, it asks once
/// who that controller is, and for the State of one tick, which the controller holds for it while
/// its loop goes on; from there on it only listens: it steps on with the Inputs that it hears, and
/// compares each tick's digest. At the first that differs it has the controller hold its State and
/// its last ticks, reads them, and names tick, stage and field.
///
/// Ticks that pass while a State is read are compared afterwards, too late to ask for what differs
/// in one of them: that is counted as unsettled.
///
/// A tick that was not heard whole is no difference: it is counted, and the State asked for anew;
/// likewise after the controller began anew. Frames in, frames out: it knows no interface and asks
/// no clock. Times are microseconds that never go back.
class LiveCheck {
 public:
  enum class State {
    kAsking,     ///< for the State to begin with
    kFollowing,  ///< listens
    kReading,    ///< what differs
    kDiffers,    ///< the end: divergence() says where
    kRefused,    ///< the end: refusal() says why
  };

  explicit LiveCheck(const Params& params);
  LiveCheck(const LiveCheck&) = delete;
  LiveCheck& operator=(const LiveCheck&) = delete;

  void take(const CanFrame& frame, std::uint64_t now_us);
  /// The next frame to send; none while it only listens.
  bool next(CanFrame& frame, std::uint64_t now_us);

  State state() const { return state_; }
  bool over() const { return state_ == State::kDiffers || state_ == State::kRefused; }
  bool differs() const { return state_ == State::kDiffers; }
  /// A digest was another one, and what the controller had is being read.
  bool suspects() const { return state_ == State::kReading; }
  /// Ticks whose digest was this PC's.
  std::uint64_t compared() const { return compared_; }
  /// Digests that were others, and that the controller's ticks came too late to look into.
  std::uint64_t unsettled() const { return unsettled_; }
  /// How often ticks were not heard whole, and the State was asked for anew.
  std::uint64_t gaps() const { return gaps_; }
  /// Controllers that began anew.
  std::uint64_t boots() const { return boots_; }
  /// The last tick compared.
  std::uint32_t tick() const { return inputs_.tick; }
  std::uint64_t digest() const { return shadow_.digest.chain; }
  /// When the last tick was heard, or an answer came; 0: never.
  std::uint64_t heard_us() const { return heard_us_; }
  const record::Divergence& divergence() const { return divergence_; }
  const std::string& refusal() const { return refusal_; }
  /// Why the last gap was one, in words.
  const std::string& gap() const { return gap_; }

 private:
  /// One SDO after the other; with each, what it is for.
  enum class Step {
    kName,
    kCore,
    kRelease,
    kHold,
    kState,
    kTicks,
    kReleaseLast,
    kDone,
  };
  static constexpr int kMostHeard = 4096;  ///< ticks kept while a State is on its way
  static constexpr std::size_t kMostReadings = 4096;
  static constexpr std::uint64_t kPause_us = 200'000;  ///< before it asks once more
  static constexpr std::uint64_t kTurn_us =
      50'000;                              ///< with a release, a new tick is kept after so long
  static constexpr int kMostMisheard = 3;  ///< with fewer than kClean good ticks between them
  static constexpr int kClean = 1000;

  void ask(Step step);
  bool hold_is_late(std::uint64_t now_us) const;
  void begin_step(std::uint64_t now_us);
  void end_step(std::uint64_t now_us);
  void fail_step(std::uint64_t now_us);
  void start();
  void follow();
  bool is_past(const HeardTick& tick) const;
  bool follows(const HeardTick& tick) const;
  bool compare(const HeardTick& tick);
  void lose(const std::string& why);
  void conclude();
  void refuse(const std::string& why);

  const Params& params_;
  TickListener listener_;
  canopen::SdoClient client_;
  State state_ = State::kAsking;
  Step step_ = Step::kName;
  bool running_ = false;  ///< the step's transfer has begun
  std::uint64_t step_began_us_ = 0, pause_until_us_ = 0;
  std::uint8_t number_[4] = {};      ///< of a short transfer
  std::vector<std::uint8_t> bytes_;  ///< of a long one
  std::uint32_t crc_ = 0;            ///< of the controller's Params
  bool begun_ = false;               ///< there is a State to go on from
  verp::State shadow_;
  Inputs inputs_;
  std::deque<HeardTick> heard_;
  std::unique_ptr<Suspicion> suspicion_;
  Testimony testimony_;
  record::Divergence divergence_;
  std::string refusal_, gap_;
  std::uint64_t compared_ = 0, gaps_ = 0, boots_ = 0, heard_us_ = 0, unsettled_ = 0;
  int misheard_ = 0;
  int clean_ = 0;  ///< ticks compared since the last gap
};

}  // namespace verp::shadow
