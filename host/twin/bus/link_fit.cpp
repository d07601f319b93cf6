#include "host/twin/bus/link_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/feetech_schedule.hpp"
#include "host/os/link/latency.hpp"

namespace verp::bus {
namespace {

constexpr int kDelays = 80;
constexpr int kSilent = 10;                        // stop after so many unanswered reads
constexpr int kShortest_ms = 4, kLongest_ms = 20;  // Params::period_us

/// Present Position of one servo, as in every tick.
struct PositionRead {
  std::uint16_t address = 0, bytes = 0;
  std::size_t wire_bytes = 0;
};

PositionRead position_read(const Params& params) {
  if (params.bus_protocol == BusProtocol::kFeetech) {
    return {feetech::address::kPresentPosition, app::feetech_bytes::kPosition,
            app::feetech_bytes::read(app::feetech_bytes::kPosition)};
  }
  return {dxl::address::kPresentPosition, 4, dxl::kInstructionBytes + 4 + dxl::kStatusBytes + 4};
}

/// A tick's two reads, if nobody answers.
std::uint32_t silence_us(const Params& params) {
  const std::size_t joints = params.servo_count(), sensors = app::sensor_devices(params);
  const bool feetech = params.bus_protocol == BusProtocol::kFeetech;
  namespace ft = app::feetech_bytes;
  const std::size_t positions = feetech ? ft::sync_read(joints, ft::kPosition + app::kMostSpare)
                                        : app::sync_read_bytes(joints, 4 + app::kMostSpare);
  const std::size_t rest =
      feetech ? ft::sync_read(sensors, feetech::sensor_block::kBytes + app::kMostSpare)
              : app::sync_read_bytes(sensors, dxl::sensor_block::kBytes + app::kMostSpare);
  return app::timeout_us(positions, joints, params.baud) +
         app::timeout_us(rest, sensors, params.baud);
}

/// Id of the first servo that answers; nothing if the caller gave up.
std::optional<std::uint8_t> somebody(Client& client, const Params& params,
                                     const std::function<bool()>& give_up) {
  for (int j = 0; j < params.servo_count() && !give_up(); ++j) {
    if (client.ping(params.joint[j].servo_id, 1)) return params.joint[j].servo_id;
  }
  if (give_up()) return std::nullopt;
  throw DeviceError(fmt::format("{}: no servo of {} answers; `verp bus doctor` finds out why",
                                client.place(), params.name));
}

[[noreturn]] void too_few(const Client& client, std::uint8_t id, const LinkDelay& delay) {
  const std::string how_many =
      delay.answered == 0 ? "none" : fmt::format("only {}", delay.answered);
  throw DeviceError(fmt::format(
      "{}: device {} answers a ping, but {} of {} reads: how late its replies are is not known; "
      "check its Status Return Level (`verp bus setup` makes it 2), the wiring, and that no other "
      "program uses this bus",
      client.place(), id, how_many, delay.asked));
}

}  // namespace

double quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

LinkDelay measure_delay(const std::function<bool()>& read, double wire_us,
                        const std::function<bool()>& give_up) {
  LinkDelay delay;
  std::vector<double> held_us;
  const auto enough = [&] {
    return delay.asked >= kDelays || (held_us.empty() && delay.asked >= kSilent);
  };
  while (!enough() && !give_up()) {
    const std::uint64_t begun_ns = link::monotonic_ns();
    const bool good = read();
    const double took_us = 1e-3 * static_cast<double>(link::monotonic_ns() - begun_ns);
    ++delay.asked;
    if (good) held_us.push_back(std::max(0.0, took_us - wire_us));
  }
  std::sort(held_us.begin(), held_us.end());
  delay.answered = static_cast<int>(held_us.size());
  delay.median_us = quantile(held_us, 0.5);
  delay.p90_us = quantile(held_us, 0.9);
  delay.worst_us = quantile(held_us, 1);
  return delay;
}

LinkDelay measure_delay(Client& client, const Params& params,
                        const std::function<bool()>& give_up) {
  const std::optional<std::uint8_t> found = somebody(client, params, give_up);
  if (!found) return {};
  const std::uint8_t id = *found;
  const PositionRead read = position_read(params);
  const LinkDelay delay =
      measure_delay([&] { return client.read_once(id, read.address, read.bytes); },
                    app::wire_us(read.wire_bytes, params.baud), give_up);
  if (2 * delay.answered < delay.asked && !give_up()) too_few(client, id, delay);
  return delay;
}

LinkFit fit(const Params& params, const LinkDelay& delay) {
  // Reads of a silent bus must not cost deadlines, nor delay the reads behind them.
  return {.period_us = params.period_us,
          .wire_us = std::max(app::serial_tick_us(params), silence_us(params)),
          .delay = delay};
}

std::uint32_t LinkFit::held_us() const {
  const double room_us = kUsable * period_us - wire_us;
  return room_us > 0 ? static_cast<std::uint32_t>(room_us / reads) : 0;
}

int LinkFit::shortest_period_ms() const {
  const double slow_us = std::max(delay.median_us, delay.p90_us);
  const auto least_ms = static_cast<int>(std::ceil((wire_us + reads * slow_us) / kUsable / 1000));
  return least_ms <= kLongest_ms ? std::max(least_ms, kShortest_ms) : 0;
}

std::string remedy(const LinkFit& fit, const Params& params, const link::Endpoint& endpoint,
                   const std::string& system_folder) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", or ") + more; };
  if (endpoint.kind == link::Endpoint::Kind::kSerial) {
    const std::string advice = link::latency_advice(endpoint.place, system_folder);
    if (!advice.empty()) add(advice);
  }
  if (const int period_ms = fit.shortest_period_ms();
      1000 * period_ms > static_cast<int>(fit.period_us)) {
    add(fmt::format("give --period {} (for good: period_us=\"{}\" in <verp:bus> of the model)",
                    period_ms, 1000 * period_ms));
  }
  // A faster bus saves only wire time: suggested only if that is enough.
  const double half_wire_us = fit.needed_us() - 0.5 * fit.wire_us;
  const bool can = endpoint.kind == link::Endpoint::Kind::kCan;
  const bool has_faster = params.bus_protocol == BusProtocol::kFeetech
                              ? feetech::baud_rate_code(2 * params.baud) != 0xFF
                              : dxl::baud_rate_code(2 * params.baud) != 0xFF;
  if (!can && has_faster && half_wire_us <= LinkFit::kUsable * fit.period_us) {
    add(fmt::format("raise the bus from {} to {} baud", params.baud, 2 * params.baud));
  }
  if (text.empty()) {
    add(can ? "use an interface that answers sooner (on PCIe or SPI), or a controller on the robot"
            : "use an adapter that answers within 1 ms (an FTDI with latency_timer 1), or a "
              "controller on the robot");
  }
  return text;
}

std::string adapter_too_slow(const Params& params, const link::Endpoint& endpoint,
                             const std::string& system_folder) {
  if (endpoint.kind != link::Endpoint::Kind::kSerial) return "";
  const auto timer_ms = link::latency_timer_ms(endpoint.place, system_folder);
  if (!timer_ms) return "";
  const double held_us = 1000.0 * *timer_ms;
  const LinkFit known = fit(
      params,
      {.asked = 1, .answered = 1, .median_us = held_us, .p90_us = held_us, .worst_us = held_us});
  if (known.fits()) return "";
  return fmt::format(
      "a period of {:g} ms has no room for two reads that are each held up for {} ms, and {:.1f} "
      "ms "
      "on the wire: {}",
      1e-3 * params.period_us, *timer_ms, 1e-3 * known.wire_us,
      link::latency_advice(endpoint.place, system_folder));
}

}  // namespace verp::bus
