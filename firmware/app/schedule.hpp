#pragma once
#include <cstddef>
#include <cstdint>

#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/doubts.hpp"
#include "firmware/app/wire_time.hpp"

/// Bytes and time of one tick of Dynamixel servos, for the loop's timeouts and export's limit.
namespace verp::app {

/// Bytes of a Sync Read with all replies.
constexpr std::size_t sync_read_bytes(std::size_t devices, std::size_t length) {
  return dxl::kInstructionBytes + 4 + devices + devices * (dxl::kStatusBytes + length);
}
constexpr std::size_t fast_sync_read_bytes(std::size_t devices, std::size_t length) {
  return dxl::kInstructionBytes + 4 + devices + dxl::kFastHeaderBytes +
         devices * (dxl::kFastBlockBytes + length);
}
constexpr std::size_t sync_write_bytes(std::size_t devices, std::size_t length) {
  return dxl::kInstructionBytes + 4 + devices * (1 + length);
}

/// A servo without Fast Sync Read would break the reply chain.
constexpr bool all_fast(const Params& params) {
  for (int j = 0; j < params.servo_count(); ++j) {
    if (params.servo[params.joint[j].servo_profile % kServoProfiles].fast_sync_read == 0) {
      return false;
    }
  }
  return params.servo_count() > 0;
}

/// Bus Watchdog setting while torque is on: servos hold by themselves a little after the controller
/// would have begun to lower the robot.
inline std::uint8_t bus_watchdog_units(const Params& params) {
  constexpr float kLater_s = 0.1F;
  constexpr float kUnit_s = 1e-6F * static_cast<float>(dxl::kBusWatchdogUnit_us);
  const std::int32_t units =
      math::to_int32((params.tuning.safety.stale_release_s + kLater_s) / kUnit_s);
  return static_cast<std::uint8_t>(units < 1                       ? 1
                                   : units > dxl::kBusWatchdogMost ? dxl::kBusWatchdogMost
                                                                   : units);
}

/// The tick's second read: IMU, feet, and one servo in turn.
constexpr std::size_t sensor_devices(const Params& params) {
  std::size_t devices = 1;
  devices += params.imu.device_id != 0 ? 1 : 0;
  for (std::uint8_t id : params.feet.device_id) devices += id != 0 ? 1 : 0;
  return devices;
}

/// Reads from Torque Enable to Hardware Error Status.
inline constexpr std::uint16_t kAlertBytes = 7;

/// Bytes of the longest tick in which every device answers: reads, one alert read, goals. Also
/// either torque, strength and a Bus Watchdog clear and set for all servos, or these for one servo
/// plus a few queried or set up again.
constexpr std::size_t schedule_bytes(const Params& params) {
  const std::size_t joints = params.servo_count();
  const std::size_t positions =
      all_fast(params) ? fast_sync_read_bytes(joints, 4) : sync_read_bytes(joints, 4);
  const std::size_t told_to_all = sync_write_bytes(joints, 2) + 3 * sync_write_bytes(joints, 1);
  const std::size_t few = joints < kResolvedAtOnce ? joints : kResolvedAtOnce;
  const std::size_t asked = sync_read_bytes(few, 1);
  const std::size_t renewed = sync_write_bytes(few, 6) + sync_write_bytes(few, 8);
  const std::size_t told_to_some =
      sync_write_bytes(1, 2) + 2 * sync_write_bytes(1, 1) + (asked > renewed ? asked : renewed);
  return positions + sync_read_bytes(sensor_devices(params), dxl::sensor_block::kBytes) +
         (dxl::kInstructionBytes + 4 + dxl::kStatusBytes + kAlertBytes) +
         sync_write_bytes(joints, 4) + (told_to_all > told_to_some ? told_to_all : told_to_some);
}

/// Time of that tick on the wire, reply slack included. Above 80 % of the period no retry fits:
/// such a robot is refused (host/robot/model/bus_time.hpp).
constexpr std::uint32_t schedule_us(const Params& params) {
  const std::size_t replies =
      (all_fast(params) ? 1u : params.servo_count()) + sensor_devices(params) + 1;
  return wire_us(schedule_bytes(params), params.baud) +
         static_cast<std::uint32_t>(replies) * kReplySlackUs;
}

}  // namespace verp::app
