#include "host/can/load_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "common/protocol/canopen/robot_load.hpp"

namespace verp::can {
namespace {

namespace plan = canopen::plan;
using canopen::Stuffing;
using plan::TickKind;

constexpr std::uint32_t kRates_hz[] = {100, 125, 200, 250};

/// What is on bus `which` of two.
Params half_of(const Params& params, int which) {
  Params half = params;
  const int first = (params.joint_count + 1) / 2;
  half.joint_count = static_cast<std::uint8_t>(which == 0 ? first : params.joint_count - first);
  const int from = which == 0 ? 0 : first;
  for (int j = 0; j < half.joint_count; ++j) half.joint[j] = params.joint[from + j];
  if (which == 0) {
    for (std::uint8_t& id : half.feet.device_id) id = 0;
  } else {
    half.imu.device_id = 0;
  }
  return half;
}

std::uint32_t worst_share(const Params& params, const LoadRow& row,
                          const canopen::BitRates& rates) {
  const plan::TickLoad load(params, {.stuffing = Stuffing::kWorst, .fd = row.fd});
  return canopen::load_permille(load.bits(TickKind::kSteady), rates, 1'000'000 / row.rate_hz);
}

/// The first drive for which this bus has no room; empty: it has room for all.
std::string too_much(const Params& params, const LoadRow& row, const canopen::BitRates& rates) {
  const auto part = std::make_unique<Params>(params);
  while (part->joint_count > 0 && worst_share(*part, row, rates) > plan::kMostLoadPermille) {
    --part->joint_count;
  }
  if (part->joint_count == params.joint_count) return "";
  const JointParams& first = params.joint[part->joint_count];
  return fmt::format("{} (node {}) and those after it do not fit: over {} % at worst", first.name,
                     first.servo_id, plan::kMostLoadPermille / 10);
}

/// Raises the row to what this bus takes. `own_imu`: of a controller's that is a node here.
void add_bus(LoadRow& row, const Params& params, bool own_imu, const canopen::BitRates& rates) {
  const plan::TickLoad bare(params, {.stuffing = Stuffing::kNone, .fd = row.fd});
  const plan::TickLoad worst(params, {.stuffing = Stuffing::kWorst, .fd = row.fd});
  const std::uint32_t period_us = 1'000'000 / row.rate_hz;
  const auto share = [&](const canopen::FrameBits& bits) {
    return canopen::load_permille(bits, rates, period_us);
  };
  const auto raise = [](std::uint32_t& most, std::uint32_t value) { most = std::max(most, value); };
  raise(row.bits_bare, bare.bits(TickKind::kSteady).all());
  raise(row.bits_worst, worst.bits(TickKind::kSteady).all());
  raise(row.bare_permille, share(bare.bits(TickKind::kSteady)));
  raise(row.worst_permille, share(worst.bits(TickKind::kSteady)));
  raise(row.change_permille, share(worst.bits(TickKind::kChange)));
  // It is a node on one of the buses.
  canopen::FrameBits told = worst.bits(TickKind::kSteady);
  told += worst.published(own_imu);
  raise(row.published_permille, share(told));
  constexpr std::uint32_t kAll = 1000;
  if (row.refusal.empty()) row.refusal = too_much(params, row, rates);
  if (row.refusal.empty() && row.change_permille > kAll) {
    row.refusal = "a change of state takes more than a period";
  }
}

}  // namespace

std::vector<LoadRow> load_table(const Params& params, std::uint32_t data_baud) {
  std::vector<LoadRow> rows;
  for (const int buses : {1, 2}) {
    for (const bool fd : {false, true}) {
      for (const std::uint32_t rate_hz : kRates_hz) {
        LoadRow row{.rate_hz = rate_hz, .buses = buses, .fd = fd, .refusal = ""};
        const canopen::BitRates rates{params.baud, fd ? data_baud : params.baud};
        const bool own_imu = params.imu.device_id == 0;
        if (buses == 1) add_bus(row, params, own_imu, rates);
        for (int which = 0; which < 2 && buses == 2; ++which) {
          add_bus(row, *std::make_unique<Params>(half_of(params, which)), own_imu, rates);
        }
        rows.push_back(row);
      }
    }
  }
  return rows;
}

}  // namespace verp::can
