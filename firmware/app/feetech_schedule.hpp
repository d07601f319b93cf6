#pragma once
#include <cstddef>
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/wire_time.hpp"

/// Bytes and time of one tick of Feetech servos.
namespace verp::app {

namespace feetech_bytes {

constexpr std::size_t kPosition = 2;
constexpr std::size_t kGoal = 4;  ///< torque, acceleration and goal, in one piece

constexpr std::size_t sync_read(std::size_t devices, std::size_t length) {
  return feetech::kInstructionBytes + 2 + devices + devices * (feetech::kStatusBytes + length);
}
constexpr std::size_t sync_write(std::size_t devices, std::size_t length) {
  return feetech::kInstructionBytes + 2 + devices * (1 + length);
}
constexpr std::size_t read(std::size_t length) {
  return feetech::kInstructionBytes + 2 + feetech::kStatusBytes + length;
}

/// The longest tick in which every device answers: two reads, goals, one torque read after an
/// alarm; strength and torque off for all, or strength of one servo and a few queried.
constexpr std::size_t tick(const Params& params) {
  const std::size_t joints = params.servo_count();
  const std::size_t few = joints < kResolvedAtOnce ? joints : kResolvedAtOnce;
  const std::size_t told_to_all = sync_write(joints, 2) + sync_write(joints, 1);
  const std::size_t told_to_some = sync_write(1, 2) + sync_write(1, 1) + sync_read(few, 1);
  return sync_read(joints, kPosition) +
         sync_read(sensor_devices(params), feetech::sensor_block::kBytes) + read(1) +
         sync_write(joints, kGoal) + (told_to_all > told_to_some ? told_to_all : told_to_some);
}

}  // namespace feetech_bytes

/// One tick of either serial protocol.
constexpr std::size_t serial_tick_bytes(const Params& params) {
  return params.bus_protocol == BusProtocol::kFeetech ? feetech_bytes::tick(params)
                                                      : schedule_bytes(params);
}
constexpr std::uint32_t serial_tick_us(const Params& params) {
  if (params.bus_protocol != BusProtocol::kFeetech) return schedule_us(params);
  const std::size_t replies = params.servo_count() + sensor_devices(params) + 1u;
  return wire_us(feetech_bytes::tick(params), params.baud) +
         static_cast<std::uint32_t>(replies) * kReplySlackUs;
}

}  // namespace verp::app
