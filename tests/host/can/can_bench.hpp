#pragma once
#include <cstdint>
#include <vector>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "common/protocol/canopen/sync.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/host/bus/fake_plant.hpp"

namespace verp::test {

/// CiA 402 drives from node 1, an IMU and two feet, 1 Mbit/s, 10 ms.
inline Params can_params(int joints) {
  constexpr float kCountsPerRad = 16384 / 6.2831853F;
  Params params = bus_params(joints);
  params.bus_protocol = BusProtocol::kCia402;
  params.baud = 1'000'000;
  params.servo[0] = {.model_number = 402, .position_p_gain = 590, .position_d_gain = 80};
  for (int j = 0; j < joints; ++j) params.joint[j].counts_per_rad = kCountsPerRad;
  return params;
}

class CanBench {
 public:
  explicit CanBench(int joints) : CanBench(can_params(joints)) {}
  explicit CanBench(const Params& robot) : params(robot) {
    for (int j = 0; j < params.joint_count; ++j) {
      plant.measured[static_cast<std::size_t>(j)] = {.position_count = 8192, .voltage_v = 12};
    }
  }

  std::vector<CanFrame> listen(std::uint64_t time_us) {
    const std::uint64_t end_us = bus.now_us() + time_us;
    std::vector<CanFrame> all;
    for (CanFrame frame; bus.bring_until(end_us, frame);) all.push_back(frame);
    return all;
  }
  void let_pass(std::uint64_t time_us) { listen(time_us); }

  canopen::Abort write(std::uint8_t node, canopen::Address at, std::int64_t value,
                       std::uint32_t bytes) {
    std::uint8_t data[8];
    canopen::put_le(data, static_cast<std::uint64_t>(value), 8);
    canopen::SdoClient client(node);
    client.download(at, data, bytes, canopen::SdoClient::Mode::kPlain, bus.now_us());
    return finish(client);
  }
  canopen::Abort read(std::uint8_t node, canopen::Address at, std::int64_t& value) {
    std::uint8_t data[8] = {};
    canopen::SdoClient client(node);
    client.upload(at, data, 8, canopen::SdoClient::Mode::kPlain, bus.now_us());
    const canopen::Abort reason = finish(client);
    const unsigned unused = 64 - 8 * client.size();
    value = client.size() == 0
                ? 0
                : static_cast<std::int64_t>(canopen::get_le(data, 8) << unused) >> unused;
    return reason;
  }
  std::int64_t value(std::uint8_t node, canopen::Address at) {
    std::int64_t got = 0;
    read(node, at, got);
    return got;
  }
  void nmt(canopen::NmtCommand command, std::uint8_t node = 0) {
    bus.send(canopen::nmt_frame(command, node));
    let_pass(1000);
  }
  void sync(std::uint8_t counter) {
    CanFrame frame = canopen::classic_frame(canopen::kSyncId, 1);
    frame.data[0] = counter;
    bus.send(frame);
  }
  void control(std::uint8_t node, std::uint16_t word) {
    write(node, canopen::cia402::object::kControlword, word, 2);
    let_pass(2000);
  }
  canopen::cia402::State state(std::uint8_t node) {
    return canopen::cia402::state_of(
        static_cast<std::uint16_t>(value(node, canopen::cia402::object::kStatusword)));
  }
  void enable(std::uint8_t node) {
    namespace cia402 = canopen::cia402;
    write(node, cia402::object::kMode, cia402::kModeCyclicPosition, 1);
    for (const std::uint16_t word :
         {cia402::kWordShutdown, cia402::kWordSwitchOn, cia402::kWordEnableOperation}) {
      control(node, word);
    }
  }
  const sim::ServoSetpoint& setpoint(int joint) { return plant.setpoint(joint); }

  Params params;
  FakePlant plant;
  can::VirtualCan bus{params, plant};

 private:
  canopen::Abort finish(canopen::SdoClient& client) {
    using State = canopen::SdoClient::State;
    constexpr std::uint64_t kStep_us = 1000;
    for (CanFrame frame; client.state() == State::kBusy;) {
      while (client.next(frame, bus.now_us())) bus.send(frame);
      if (client.state() != State::kBusy) break;
      if (bus.bring_until(bus.now_us() + kStep_us, frame)) client.receive(frame, bus.now_us());
    }
    return client.state() == State::kDone ? canopen::Abort::kNone : client.reason();
  }
};

}  // namespace verp::test
