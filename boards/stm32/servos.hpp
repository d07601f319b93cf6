#pragma once
#include <cstddef>
#include <cstdint>

#include "boards/stm32/hardware.hpp"
#include "boards/stm32/servo_power.hpp"
#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"

namespace verp::board {

/// The servo port before there is a loop, and the switch of the servos' power.
struct Servos {
  /// Without a robot nobody knows their baud rate.
  bool open() { return has_robot && open_servo_port(start, baud); }
  void power(bool on) { supply.set(on); }
  /// All of them, whoever they are: nobody replies, so three times.
  void release() {
    constexpr std::uint8_t kOff = 0;
    std::uint8_t frame[32];
    const std::size_t size = dxl::encode_write(frame, sizeof frame, dxl::kBroadcast,
                                               dxl::address::kTorqueEnable, &kOff, sizeof kOff);
    for (int times = 0; times < 3; ++times) servo_port.write(frame, size, 10'000);
  }

  const Start& start;
  std::uint32_t baud;
  bool has_robot;
  ServoPower<Io>& supply;
};

}  // namespace verp::board
