#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/twin/bus/client.hpp"

/// Whether a robot's traffic fits its control period on a link that holds bytes back, as USB serial
/// adapters do.
namespace verp::bus {

/// The smallest of `sorted` that is not below `share` of them; 0 of none.
double quantile(const std::vector<double>& sorted, double share);

/// How long the reads that were answered took beyond their bytes' time on the wire, there and back.
struct LinkDelay {
  int asked = 0, answered = 0;
  double median_us = 0, p90_us = 0, worst_us = 0;
};

/// Reads one servo of `params` again and again; ends early, perhaps with nothing asked, when
/// `give_up` says so. Otherwise throws DeviceError if no servo answers a ping, or fewer than half
/// of the reads are answered.
LinkDelay measure_delay(Client& client, const Params& params, const std::function<bool()>& give_up);

/// The same of any `read`, which says whether it was answered and takes `wire_us` on the wire.
/// Fewer than half of them may have been answered.
LinkDelay measure_delay(const std::function<bool()>& read, double wire_us,
                        const std::function<bool()>& give_up);

/// One tick on such a link: its bytes, and its reads, each of which waits for the one before.
struct LinkFit {
  std::uint32_t period_us = 0;
  std::uint32_t wire_us = 0;  ///< all bytes of the tick, and what reads of silent servos wait for
  LinkDelay delay;
  int reads = 2;  ///< positions, sensors; on CAN: SYNCs

  /// Share of the period that bytes and delays may take: the rest is the controller's own.
  static constexpr double kUsable = 0.95;

  double needed_us() const { return wire_us + reads * delay.median_us; }
  /// Not if no read was answered: nothing is known then.
  bool fits() const { return delay.answered > 0 && needed_us() <= kUsable * period_us; }
  /// Also for the slowest tenth of the reads.
  bool fits_well() const {
    return delay.answered > 0 && wire_us + reads * delay.p90_us <= kUsable * period_us;
  }
  /// What a tick's reads may each be held up: a reply that is later is not waited for.
  std::uint32_t held_us() const;
  /// The shortest period of whole milliseconds in which it fits well; 0: none that a robot may
  /// have.
  int shortest_period_ms() const;
};

LinkFit fit(const Params& params, const LinkDelay& delay);

/// What a master on this PC can do about a link that doesn't fit, as words after a semicolon.
std::string remedy(const LinkFit& fit, const Params& params, const link::Endpoint& endpoint,
                   const std::string& system_folder = "/sys");

/// For the twin, which answers: an adapter known to hold its bytes back for too long, as a line
/// with a remedy; empty: none is known.
std::string adapter_too_slow(const Params& params, const link::Endpoint& endpoint,
                             const std::string& system_folder = "/sys");

}  // namespace verp::bus
