#pragma once
#include <cstdint>

#include "host/run/shadow/check.hpp"
#include "host/run/shadow/tick_port.hpp"

namespace verp::shadow {

/// A controller once more, beside one at the end of a serial link that is not its servo bus. The
/// controller keeps the records of its last ticks (firmware/app/tick_log.hpp); this PC fetches them
/// at its own pace, one by one, steps on with their Inputs and compares. The controller never waits
/// for it: ticks that it has dropped before they were fetched are counted as a gap, and its State
/// is read anew.
class PolledCheck final : public Check {
 public:
  /// `params` and `port` outlive it.
  PolledCheck(const Params& params, TickPort& port, const action::Library& own = {})
      : Check(params, own), port_(port) {}

  /// One request, or a few; false if there is nothing new, or nobody answers.
  bool turn(std::uint64_t now_us);

 private:
  static constexpr std::size_t kTicks = app::TickLog<>::kTicks;

  bool good(TickPort::Answer answer);
  bool begin();
  bool hold(app::TickLog<>::Hold what);
  bool read_state();
  bool read_ticks();
  bool follow();
  bool compare(const TickRecord& record);
  bool settle(const TickRecord& record);

  TickPort& port_;
  std::uint32_t next_ = 0;  ///< tick
  std::uint64_t now_us_ = 0;
};

}  // namespace verp::shadow
