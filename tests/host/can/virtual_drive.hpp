#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/protocol/canopen/emcy.hpp"
#include "tests/host/can/can_bench.hpp"

namespace verp::test {

inline constexpr std::uint8_t kNode = 1;

class VirtualDrive : public ::testing::Test {
 protected:
  VirtualDrive() { bench.let_pass(2000); }

  void target(std::int32_t count) {
    bench.write(kNode, canopen::cia402::object::kTargetPosition, count, 4);
  }
  std::uint16_t status() {
    return static_cast<std::uint16_t>(bench.value(kNode, canopen::cia402::object::kStatusword));
  }
  sim::ServoMeasurement& measured() { return bench.plant.measured[0]; }
  std::vector<canopen::Emergency> emergencies(std::uint64_t time_us) {
    std::vector<canopen::Emergency> all;
    canopen::Emergency emergency;
    for (const CanFrame& frame : bench.listen(time_us)) {
      if (canopen::decode_emcy(frame, emergency)) all.push_back(emergency);
    }
    return all;
  }
  /// By 1016h, for `beats` heartbeats of 20 ms.
  void watch_master(std::int16_t option, std::int16_t quick_stop, int beats) {
    bench.write(kNode, canopen::cia402::object::kAbortConnection, option, 2);
    bench.write(kNode, canopen::cia402::object::kQuickStopOption, quick_stop, 2);
    bench.write(kNode, canopen::cia402::object::kConsumerHeartbeat, 0x7F0000 | 100, 4);
    for (int i = 0; i < beats; ++i) {
      bench.bus.send(canopen::heartbeat_frame(canopen::plan::kControllerNode,
                                              canopen::NmtState::kOperational));
      bench.let_pass(20'000);
    }
  }

  CanBench bench{1};
};

}  // namespace verp::test
