#include "host/robot/model/bus_time.hpp"

#include <fmt/format.h>

#include "common/protocol/canopen/robot_load.hpp"
#include "firmware/app/feetech_schedule.hpp"
#include "host/robot/model/bounds.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {
namespace {

namespace plan = canopen::plan;

constexpr double kMostShare = plan::kMostLoadPermille / 1000.0;

bool is_can(const Params& params) {
  return params.bus_protocol == BusProtocol::kCia402;
}

bool has_room(const Params& params) {
  if (is_can(params)) {
    return plan::has_room(params, false, {params.baud, params.baud}, params.period_us);
  }
  return bus_time(params).share <= kMostShare;
}

/// In whole milliseconds; 0: no allowed period fits.
std::uint32_t shortest_period_us(Params params) {
  constexpr std::uint32_t kStep_us = 1000;
  for (params.period_us = kShortestPeriod_us; params.period_us <= kLongestPeriod_us;
       params.period_us += kStep_us) {
    if (has_room(params)) return params.period_us;
  }
  return 0;
}

std::string remedy(const Params& params) {
  constexpr std::uint32_t kFastest = 1'000'000;  // of CAN and of Feetech
  std::string text;
  if (const std::uint32_t period_us = shortest_period_us(params); period_us != 0) {
    text =
        fmt::format("a period of {} ms has room (period_us=\"{}\")", period_us / 1000, period_us);
  }
  if (params.bus_protocol == BusProtocol::kDynamixel2 || params.baud < kFastest) {
    text += text.empty() ? "raise baud" : ", or raise baud";
  }
  if (text.empty()) text = "drive fewer joints on this bus";
  return is_can(params) ? text + "; `verp bus load` prints what fits" : text;
}

}  // namespace

BusTime bus_time(const Params& params) {
  BusTime time;
  if (is_can(params)) {
    const canopen::BitRates rates{params.baud, params.baud};
    const plan::TickLoad load(params, {});
    time.us = plan::tick_us(params);
    time.change_us =
        1e-3 * static_cast<double>(wire_time_ns(load.bits(plan::TickKind::kChange), rates));
    time.bits = load.bits(plan::TickKind::kSteady).all();
  } else {
    time.us = app::serial_tick_us(params);  // of the longest tick
    time.change_us = time.us;
    time.bytes = app::serial_tick_bytes(params);
    time.bits = 10 * time.bytes;
  }
  time.share = time.us / params.period_us;
  return time;
}

void require_bus(const Entity& entity, const Params& params) {
  const int fitting = plan::drives_that_fit(params, has_room);
  if (fitting == params.servo_count()) return;
  const BusTime time = bus_time(params);
  const auto percent = [&](double us) { return 100 * us / params.period_us; };
  std::string needs = fmt::format(
      "a tick's packets take {:.1f} % of {} us at {} baud at worst ({:.0f} % is admitted)",
      percent(time.us), params.period_us, params.baud, 100 * kMostShare);
  if (time.change_us > params.period_us) {
    needs += fmt::format(", those of a change of all states {:.1f} %", percent(time.change_us));
  }
  const JointParams& first = params.joint[fitting];
  throw LoadError(entity.bus_file, entity.bus_line,
                  fmt::format("{} ({} {}) and those after it do not fit the bus: {}", first.name,
                              is_can(params) ? "node" : "id", first.servo_id, needs),
                  remedy(params));
}

}  // namespace verp::model
