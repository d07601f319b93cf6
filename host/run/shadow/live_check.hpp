#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "common/protocol/canopen/sdo_client.hpp"
#include "host/run/shadow/check.hpp"
#include "host/run/shadow/tick_listener.hpp"

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
class LiveCheck final : public Check {
 public:
  explicit LiveCheck(const Params& params, const action::Library& own = {});

  void take(const CanFrame& frame, std::uint64_t now_us);
  /// The next frame to send; none while it only listens.
  bool next(CanFrame& frame, std::uint64_t now_us);

 private:
  /// One SDO after the other; with each, what it is for.
  enum class Step {
    kName,
    kCore,
    kActions,
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
      50'000;  ///< with a release, a new tick is kept after so long

  void ask(Step step);
  bool hold_is_late(std::uint64_t now_us) const;
  void begin_step(std::uint64_t now_us);
  void end_step(std::uint64_t now_us);
  void fail_step(std::uint64_t now_us);
  void start();
  void follow();
  bool is_past(const HeardTick& tick) const;
  bool follows(const HeardTick& tick) const;
  void compare(const HeardTick& tick);
  void lose(const std::string& why) override;

  TickListener listener_;
  canopen::SdoClient client_;
  Step step_ = Step::kName;
  bool running_ = false;  ///< the step's transfer has begun
  std::uint64_t step_began_us_ = 0, pause_until_us_ = 0;
  std::uint8_t number_[4] = {};      ///< of a short transfer
  std::vector<std::uint8_t> bytes_;  ///< of a long one
  std::uint32_t crc_ = 0;            ///< of the controller's Params
  bool begun_ = false;               ///< there is a State to go on from
  Inputs inputs_;
  std::deque<HeardTick> heard_;
  std::unique_ptr<Suspicion> suspicion_;
};

}  // namespace verp::shadow
