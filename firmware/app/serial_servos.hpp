#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/dynamixel_servos.hpp"
#include "firmware/app/feetech_servos.hpp"

namespace verp::app {

/// Torque off for all servos, without a reply. Returns the frame's size; `protocol` is serial.
inline std::size_t encode_torque_off(std::uint8_t* frame, std::size_t capacity,
                                     BusProtocol protocol) {
  constexpr std::uint8_t kOff = 0;
  return protocol == BusProtocol::kFeetech
             ? feetech::encode_write(frame, capacity, feetech::kBroadcast,
                                     feetech::address::kTorqueEnable, &kOff, sizeof kOff)
             : dxl::encode_write(frame, capacity, dxl::kBroadcast, dxl::address::kTorqueEnable,
                                 &kOff, sizeof kOff);
}

/// The ServoBinding (contracts.hpp) of a FrameBus, in the protocol of the robot's Params.
class SerialServos {
 public:
  SerialServos(const Params& params, hal::FrameBus& bus)
      : feetech_(params.bus_protocol == BusProtocol::kFeetech),
        either_(feetech_ ? Either(params, bus, &Either::feetech)
                         : Either(params, bus, &Either::dynamixel)) {}

  BringUpReport bring_up() {
    return feetech_ ? either_.feetech.bring_up() : either_.dynamixel.bring_up();
  }
  void limit_torque(std::uint8_t percent) {
    feetech_ ? either_.feetech.limit_torque(percent) : either_.dynamixel.limit_torque(percent);
  }
  void read_positions(Inputs& inputs) {
    feetech_ ? either_.feetech.read_positions(inputs) : either_.dynamixel.read_positions(inputs);
  }
  void read_sensors(Inputs& inputs, bool imu) {
    feetech_ ? either_.feetech.read_sensors(inputs, imu)
             : either_.dynamixel.read_sensors(inputs, imu);
  }
  void heard_nothing_for(std::uint64_t time_us) {
    feetech_ ? either_.feetech.heard_nothing_for(time_us)
             : either_.dynamixel.heard_nothing_for(time_us);
  }
  void send(const Outputs& outputs) {
    feetech_ ? either_.feetech.send(outputs) : either_.dynamixel.send(outputs);
  }
  std::uint64_t now_us() {
    return feetech_ ? either_.feetech.now_us() : either_.dynamixel.now_us();
  }
  const BusCounters& counters() const {
    return feetech_ ? either_.feetech.counters() : either_.dynamixel.counters();
  }
  std::uint32_t damaged() const {
    return feetech_ ? either_.feetech.damaged() : either_.dynamixel.damaged();
  }
  std::uint32_t noise() const {
    return feetech_ ? either_.feetech.noise() : either_.dynamixel.noise();
  }
  const JointEffort* efforts() const { return nullptr; }

 private:
  /// Without a heap, room for one of them.
  union Either {
    Either(const Params& params, hal::FrameBus& bus, DynamixelServos Either::*)
        : dynamixel(params, bus) {}
    Either(const Params& params, hal::FrameBus& bus, FeetechServos Either::*)
        : feetech(params, bus) {}
    DynamixelServos dynamixel;
    FeetechServos feetech;
  };

  const bool feetech_;
  Either either_;
};

}  // namespace verp::app
