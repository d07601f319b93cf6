#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/bus/client.hpp"

namespace verp::bus {

/// Smallest element with at least `share` of them at or below it; 0 if empty.
double quantile(const std::vector<double>& sorted, double share);

/// Delay of answered reads beyond their wire time.
struct LinkDelay {
  int asked = 0, answered = 0;
  double median_us = 0, p90_us = 0, worst_us = 0;
};

/// Reads one servo repeatedly until `give_up`. Throws DeviceError if no servo answers, or fewer
/// than half of the reads.
LinkDelay measure_delay(Client& client, const Params& params, const std::function<bool()>& give_up);

/// With any `read`, which returns whether it was answered. Fewer than half may be answered.
LinkDelay measure_delay(const std::function<bool()>& read, double wire_us,
                        const std::function<bool()>& give_up);

/// Time of one tick on such a link; each read waits for the one before.
struct LinkFit {
  std::uint32_t period_us = 0;
  std::uint32_t wire_us = 0;  ///< with the timeouts of silent servos
  LinkDelay delay;
  int reads = 2;  ///< positions and sensors; on CAN: SYNCs

  /// Share of the period; the controller needs the rest.
  static constexpr double kUsable = 0.95;

  double needed_us() const { return wire_us + reads * delay.median_us; }
  /// False without an answered read.
  bool fits() const { return delay.answered > 0 && needed_us() <= kUsable * period_us; }
  /// Fits even with the slowest tenth of the reads.
  bool fits_well() const {
    return delay.answered > 0 && wire_us + reads * delay.p90_us <= kUsable * period_us;
  }
  /// Delay allowed for each read of a tick.
  std::uint32_t held_us() const;
  /// Shortest period that fits well, in whole milliseconds; 0: no allowed period fits.
  int shortest_period_ms() const;
};

LinkFit fit(const Params& params, const LinkDelay& delay);

/// Advice for a link that does not fit, as words after a semicolon.
std::string remedy(const LinkFit& fit, const Params& params, const link::Endpoint& endpoint,
                   const std::string& system_folder = "/sys");

/// For the twin: one line with a remedy if the adapter delays bytes too long, else empty.
std::string adapter_too_slow(const Params& params, const link::Endpoint& endpoint,
                             const std::string& system_folder = "/sys");

}  // namespace verp::bus
