#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/twin/bus/client.hpp"

namespace verp::tool {

/// Reads of one device, from the first byte sent to the last received.
struct BusBench {
  std::uint64_t good = 0;
  double duration_s = 0;
  std::uint64_t payload_bytes = 0;  ///< bytes read
  double median_us = 0, p99_us = 0, worst_us = 0;
  std::uint32_t crc_errors = 0, timeouts = 0, errors = 0;
  hal::LinkErrors link;

  double round_trips_per_s() const {
    return duration_s > 0 ? static_cast<double>(good) / duration_s : 0;
  }
};

/// Ends early on interruption.
BusBench run_bus_bench(bus::Client& client, std::uint8_t id, std::uint16_t address,
                       std::uint16_t size, double seconds);
/// Works on any bus: `read` makes one read of `size` bytes; false: no answer.
BusBench run_bus_bench(const std::function<bool()>& read, std::uint16_t size, double seconds);

std::string to_text(const BusBench& result);
cli::Json to_json(const BusBench& result);

/// Warns if the adapter behind `device` delays bytes.
void advise_latency(const std::string& device);

}  // namespace verp::tool
