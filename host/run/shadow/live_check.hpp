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

/// Shadow of a controller on a CAN bus. After the first tick heard, it asks once for the
/// controller's identity and for the State of one tick, which the controller holds while its loop
/// goes on. From then on it only listens: it steps with the Inputs that it hears and compares each
/// tick's digest. At the first difference the controller holds its State and last ticks; this class
/// reads them and names tick, stage and field.
///
/// Ticks that pass during that reading are compared afterwards. A difference in one of them comes
/// too late to examine and counts as unsettled.
///
/// A tick that was not heard completely is not a difference: it counts as a gap, and the State is
/// requested again, as after a restart of the controller. The class consumes and produces frames;
/// it uses no interface and no clock. Times are monotonic microseconds.
class LiveCheck final : public Check {
 public:
  explicit LiveCheck(const Params& params, const action::Library& own = {});

  void take(const CanFrame& frame, std::uint64_t now_us);
  /// The next frame to send; false while it only listens.
  bool next(CanFrame& frame, std::uint64_t now_us);

 private:
  /// The purpose of each SDO transfer, in order.
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
  static constexpr int kMostHeard = 4096;  ///< ticks kept during the transfer of a State
  static constexpr std::size_t kMostReadings = 4096;
  static constexpr std::uint64_t kPause_us = 200'000;  ///< before a retry
  static constexpr std::uint64_t kTurn_us =
      50'000;  ///< after a release, the controller records a new tick within this time

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
  std::uint8_t number_[4] = {};      ///< data of a short transfer
  std::vector<std::uint8_t> bytes_;  ///< data of a long transfer
  std::uint32_t crc_ = 0;            ///< of the controller's Params
  bool begun_ = false;               ///< there is a State to step from
  Inputs inputs_;
  std::deque<HeardTick> heard_;
  std::unique_ptr<Suspicion> suspicion_;
};

}  // namespace verp::shadow
