#include "host/twin/can/load_table.hpp"

#include <algorithm>

#include "common/protocol/canopen/robot_load.hpp"

namespace verp::can {
namespace {

namespace plan = canopen::plan;
using canopen::Stuffing;
using plan::TickKind;

constexpr std::uint32_t kRates_hz[] = {100, 125, 200, 250};

/// Bus `which` of two; its drives are the `first` ones on bus 0.
Params half_of(const Params& params, int which, int first) {
  Params half = params;
  half.joint_count = static_cast<std::uint8_t>(which == 0 ? first : params.servo_count() - first);
  half.followers = 0;
  const int from = which == 0 ? 0 : first;
  for (int j = 0; j < half.joint_count; ++j) half.joint[j] = params.joint[from + j];
  if (which == 0) {
    for (std::uint8_t& id : half.feet.device_id) id = 0;
  } else {
    half.imu.device_id = 0;
  }
  return half;
}

/// Raises the row to the load of the bus whose first drive is that of joint `from`. `own_imu`: the
/// controller's IMU is a node.
void add_bus(LoadRow& row, const Params& params, int from, bool own_imu,
             const canopen::BitRates& rates) {
  const std::uint32_t period_us = 1'000'000 / row.rate_hz;
  const auto load = [&](Stuffing stuffing) {
    return plan::TickLoad(params, {.stuffing = stuffing, .fd = row.fd});
  };
  const auto raise = [](std::uint32_t& most, std::uint32_t value) { most = std::max(most, value); };
  const auto raise_both = [&](std::uint32_t& most, std::uint32_t& permille, Stuffing stuffing) {
    const canopen::FrameBits bits = load(stuffing).bits(TickKind::kSteady);
    raise(most, bits.all());
    raise(permille, canopen::load_permille(bits, rates, period_us));
  };
  raise_both(row.bits_bare, row.bare_permille, Stuffing::kNone);
  raise_both(row.bits_expected, row.expected_permille, Stuffing::kExpected);
  raise_both(row.bits_worst, row.worst_permille, Stuffing::kWorst);
  const plan::TickLoad worst = load(Stuffing::kWorst);
  raise(row.change_permille,
        canopen::load_permille(worst.bits(TickKind::kChange), rates, period_us));
  canopen::FrameBits told = worst.bits(TickKind::kSteady);
  told += worst.published(own_imu);
  raise(row.published_permille, canopen::load_permille(told, rates, period_us));
  const int fitting = plan::drives_that_fit(
      params, [&](const Params& part) { return plan::has_room(part, row.fd, rates, period_us); });
  if (!row.no_room && fitting < params.servo_count()) row.no_room = from + fitting;
}

}  // namespace

std::vector<LoadRow> load_table(const Params& params, std::uint32_t data_baud) {
  std::vector<LoadRow> rows;
  for (const int buses : {1, 2}) {
    for (const bool fd : {false, true}) {
      for (const std::uint32_t rate_hz : kRates_hz) {
        LoadRow row{.rate_hz = rate_hz, .buses = buses, .fd = fd, .no_room = {}};
        const canopen::BitRates rates{params.baud, fd ? data_baud : params.baud};
        const bool own_imu = params.imu.device_id == 0;
        const int first = (params.servo_count() + 1) / 2;
        if (buses == 1) add_bus(row, params, 0, own_imu, rates);
        for (int which = 0; which < 2 && buses == 2; ++which) {
          add_bus(row, half_of(params, which, first), which * first, own_imu, rates);
        }
        rows.push_back(row);
      }
    }
  }
  return rows;
}

}  // namespace verp::can
