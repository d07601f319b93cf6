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

/// Shadow of a CAN controller. After the first tick it asks once for identity and for one tick's
/// State, which the controller holds while its loop goes on. Then it only listens: it steps with
/// the heard Inputs and compares each digest. At the first difference it reads the controller's
/// held State and last ticks, and names tick, stage and field.
///
/// Ticks during that reading are compared afterwards; a difference there is unsettled. An
/// incompletely heard tick is a gap: the State is requested again. Times are monotonic
/// microseconds.
class LiveCheck final : public Check {
 public:
  explicit LiveCheck(const Params& params, const action::Library& own = {});

  void take(const CanFrame& frame, std::uint64_t now_us);
  /// The next frame to send; false while it only listens.
  bool next(CanFrame& frame, std::uint64_t now_us);

 private:
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
  static constexpr int kMostHeard = 4096;  ///< ticks kept during a State's transfer
  static constexpr std::size_t kMostReadings = 4096;
  static constexpr std::uint64_t kPause_us = 200'000;  ///< before a retry
  static constexpr std::uint64_t kTurn_us = 50'000;  ///< after a release, a new tick comes by then

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
  bool running_ = false;  ///< the transfer has begun
  std::uint64_t step_began_us_ = 0, pause_until_us_ = 0;
  std::uint8_t number_[4] = {};      ///< short transfer
  std::vector<std::uint8_t> bytes_;  ///< long transfer
  std::uint32_t crc_ = 0;            ///< of the controller's Params
  bool begun_ = false;               ///< there is a State to step from
  Inputs inputs_;
  std::deque<HeardTick> heard_;
  std::unique_ptr<Suspicion> suspicion_;
};

}  // namespace verp::shadow
