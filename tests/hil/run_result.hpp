#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "common/protocol/controller_table.hpp"
#include "tests/hil/operator_desk.hpp"

namespace verp::test {

struct Registers {
  std::uint8_t mode = 0, reset_cause = 0, refused_joint = 0;
  std::uint32_t tick = 0, faults = 0, fresh = 0;
  std::uint32_t crc_errors = 0, timeouts = 0, strays = 0, noise = 0, overruns = 0, misses = 0;
  std::uint32_t refused = 0, bus_errors = 0;
  std::array<dxl::controller::DeviceState, dxl::controller::kDevices> state{};
  std::array<std::uint16_t, dxl::controller::kDevices> age{};
  std::array<std::uint32_t, dxl::controller::kDevices> errors{};

  std::uint32_t counted() const { return crc_errors + timeouts + strays + noise + misses; }
  std::uint32_t missed_reports() const;
};
Registers read_registers(OperatorDesk& desk);

struct RunResult {
  std::string violation;  ///< broken rule or promise
  std::uint32_t events = 0;
  int joint = 0;  ///< of the event's servo
  std::uint8_t joint_id = 0;
  Registers before;
  Registers during;  ///< when the fault ended
  Registers after;
  std::uint32_t seen = 0;           ///< bit m: was in mode m
  std::uint32_t changes = 0;        ///< of mode, during the fault
  std::uint32_t walking_ticks = 0;  ///< since the fault began
  std::uint32_t ticks = 0;
  std::uint64_t worst_tick_us = 0;  ///< bus time
  double distance_m = 0;            ///< physics only
  bool stale = false;               ///< a servo or the IMU was silent for stale_hold_s
  bool fallen = false;
  bool ready = false;  ///< walked before the fault
};

}  // namespace verp::test
