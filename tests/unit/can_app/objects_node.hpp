#pragma once
#include <cstdint>

#include "common/protocol/canopen/device.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/controller_objects.hpp"
#include "tests/unit/app/operator_bench.hpp"

namespace verp::app::test {

inline constexpr std::uint8_t kNode = 100;
inline constexpr canopen::DeviceSize kSize = {1, 1, 8, 1};

struct Node {
  explicit Node(Images& images, const OperatorSetup& setup = {})
      : registers(kRobot, setup, images),
        objects(registers, images),
        device(objects, {0, "controller", 0, 0, 0, 0}, kNode) {
    device.start();
    state.tuning = kRobot.tuning;
  }
  void arm(bool on) {
    outputs.torque_enable = on ? 1 : 0;
    registers.record({state.digest, inputs}, state, outputs);
  }
  canopen::Abort run() {
    canopen::Frame frame;
    for (std::uint64_t now_us = 0; client.state() == canopen::SdoClient::State::kBusy;
         now_us += 100) {
      while (client.next(frame, now_us)) device.receive(frame, now_us);
      while (device.next(frame, now_us)) client.receive(frame, now_us);
    }
    return client.state() == canopen::SdoClient::State::kDone ? canopen::Abort::kNone
                                                              : client.reason();
  }
  canopen::Abort write(canopen::Address at, const void* data, std::uint32_t size,
                       canopen::SdoClient::Mode mode = canopen::SdoClient::Mode::kPlain) {
    client.download(at, static_cast<const std::uint8_t*>(data), size, mode, 0);
    return run();
  }
  canopen::Abort read(canopen::Address at, std::uint8_t* buffer, std::uint32_t size,
                      canopen::SdoClient::Mode mode = canopen::SdoClient::Mode::kPlain) {
    client.upload(at, buffer, size, mode, 0);
    return run();
  }

  OperatorRegisters registers;
  ControllerObjects objects;
  canopen::Device<ControllerObjects, kSize> device;
  canopen::SdoClient client{kNode};
  State state;
  Inputs inputs;
  Outputs outputs;
};

}  // namespace verp::app::test
