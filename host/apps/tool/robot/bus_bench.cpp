#include "host/apps/tool/robot/bus_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/os/link/latency.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/twin/bus/link_fit.hpp"

namespace verp::tool {
BusBench run_bus_bench(const std::function<bool()>& read, std::uint16_t size, double seconds) {
  BusBench result;
  std::vector<double> took_us;
  const std::uint64_t start_ns = link::monotonic_ns();
  const auto end_ns = start_ns + static_cast<std::uint64_t>(seconds * 1e9);
  std::uint64_t now_ns = start_ns;
  while (now_ns < end_ns && !cli::interrupted()) {
    const std::uint64_t begun_ns = now_ns;
    const bool good = read();
    now_ns = link::monotonic_ns();
    if (good) {
      took_us.push_back(static_cast<double>(now_ns - begun_ns) * 1e-3);
    } else {
      ++result.timeouts;
    }
  }
  std::sort(took_us.begin(), took_us.end());
  result.good = took_us.size();
  result.duration_s = static_cast<double>(now_ns - start_ns) * 1e-9;
  result.payload_bytes = result.good * size;
  result.median_us = bus::quantile(took_us, 0.5);
  result.p99_us = bus::quantile(took_us, 0.99);
  result.worst_us = bus::quantile(took_us, 1);
  return result;
}

BusBench run_bus_bench(bus::Client& client, std::uint8_t id, std::uint16_t address,
                       std::uint16_t size, double seconds) {
  const app::BusCounters before = client.counters();
  const std::uint32_t crc_before = client.crc_errors();
  BusBench result =
      run_bus_bench([&] { return client.read_once(id, address, size); }, size, seconds);
  result.crc_errors = client.crc_errors() - crc_before;
  result.timeouts = client.counters().timeouts - before.timeouts;
  result.errors = client.counters().errors - before.errors;
  result.link = client.link_errors();
  return result;
}

std::string to_text(const BusBench& result) {
  return fmt::format(
      "{:.0f} round trips/s ({} in {:.2f} s, {:.1f} kB/s read)\n"
      "latency: median {:.0f} us, 99 % {:.0f} us, longest {:.0f} us\n"
      "trouble: {} CRC errors, {} timeouts, {} refused; link: {} overruns, {} framing errors, {} "
      "losses\n",
      result.round_trips_per_s(), result.good, result.duration_s,
      static_cast<double>(result.payload_bytes) / result.duration_s * 1e-3, result.median_us,
      result.p99_us, result.worst_us, result.crc_errors, result.timeouts, result.errors,
      result.link.overruns, result.link.framing, result.link.losses);
}

cli::Json to_json(const BusBench& result) {
  return {{"round_trips_per_s", result.round_trips_per_s()},
          {"round_trips", result.good},
          {"duration_s", result.duration_s},
          {"read_bytes", result.payload_bytes},
          {"latency_median_us", result.median_us},
          {"latency_p99_us", result.p99_us},
          {"latency_max_us", result.worst_us},
          {"crc_errors", result.crc_errors},
          {"timeouts", result.timeouts},
          {"refused", result.errors},
          {"link_overruns", result.link.overruns},
          {"link_framing", result.link.framing},
          {"link_losses", result.link.losses}};
}

void advise_latency(const std::string& device) {
  const std::string advice = link::latency_advice(device);
  if (!advice.empty()) cli::complain(advice);
}

}  // namespace verp::tool
