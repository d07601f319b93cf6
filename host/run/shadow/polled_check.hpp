#pragma once
#include <cstdint>

#include "host/run/shadow/check.hpp"
#include "host/run/shadow/tick_port.hpp"

namespace verp::shadow {

/// Shadow of a controller at the end of a serial link other than its servo bus. The controller
/// keeps records of its last ticks (firmware/app/tick_log.hpp). This PC fetches them one by one at
/// its own pace, steps with their Inputs and compares. The controller never waits. Ticks that it
/// dropped before they were fetched count as a gap, and its State is read again.
class PolledCheck final : public Check {
 public:
  /// The caller keeps `params` and `port` alive.
  PolledCheck(const Params& params, TickPort& port, const action::Library& own = {})
      : Check(params, own), port_(port) {}

  /// Makes a few requests; false if there is nothing new or no answer.
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
  std::uint32_t next_ = 0;  ///< the next tick to fetch
  std::uint64_t now_us_ = 0;
};

}  // namespace verp::shadow
