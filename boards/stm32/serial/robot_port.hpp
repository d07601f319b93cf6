#pragma once
#include <cstddef>
#include <cstdint>

#include "boards/stm32/ports.hpp"
#include "common/model/params.hpp"
#include "firmware/app/link_bus.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "firmware/app/operator_registers.hpp"
#include "firmware/app/serial_servos.hpp"

/// The port to a robot on the servo port. Alternative: boards/stm32/can.
namespace verp::board {

/// Params choose the family at boot.
constexpr bool drives(BusProtocol protocol) {
  return protocol == BusProtocol::kDynamixel2 || protocol == BusProtocol::kFeetech;
}
inline constexpr unsigned kRobotInterrupts[] = {kServoPort.interrupt, kServoPort.dma_interrupt};

template <class Io, class UsartKind, class Timer>
struct RobotWiring {
  using Side = PortKind<std::remove_cvref_t<decltype(kServoPort)>, Io, UsartKind, Timer>;
  using Port = typename Side::Port;

  static Port make(Timer& timer) { return Side::make(kServoPort, kFamily, timer); }
  static void connect(std::uint8_t priority) { Side::connect(kServoPort, priority); }
  /// False: no divider makes this rate.
  static bool open(Port& port, const hal::stm32::Clocks& clocks, std::uint32_t baud) {
    return Side::open(port, kServoPort, clocks, baud);
  }
  /// Sends torque off to all servos, three times, since there is no reply.
  static void release(Port& port, BusProtocol protocol) {
    std::uint8_t frame[32];
    const std::size_t size = app::encode_torque_off(frame, sizeof frame, protocol);
    for (int times = 0; times < 3; ++times) port.write(frame, size, 10'000);
  }
};

/// Ticks are published only at the operator's port.
template <class Port>
class RobotNode {
 public:
  using LoopPort = Port;
  RobotNode(Port& port, const Params&, app::OperatorRegisters&, app::Images&) : port_(port) {}
  Port& port() { return port_; }
  void tell(const Inputs&) {}

 private:
  Port& port_;
};

template <class Port, class Idle>
using LockstepOn = app::LockstepBus<Port, Idle>;

/// The far end is real servos. `Watch` is called when the port is read and no tick is due soon.
template <class Port, class Timer, class Watch>
class RealTimeOn {
  struct Patient final : hal::ByteLink {
    Patient(Port& of, Watch each) : port(of), watch(each) {}
    std::size_t write(const std::uint8_t* data, std::size_t size,
                      std::uint32_t timeout_us) override {
      return port.write(data, size, timeout_us);
    }
    std::size_t read(std::uint8_t* buffer, std::size_t capacity,
                     std::uint32_t timeout_us) override {
      watch();
      return port.read(buffer, capacity, timeout_us);
    }
    bool connected() const override { return port.connected(); }
    hal::LinkErrors errors() const override { return port.errors(); }

    Port& port;
    Watch watch;
  };

 public:
  using Bus = app::LinkBus<Patient, Timer>;

  RealTimeOn(Port& port, const Timer& timer, Watch watch, std::uint32_t held_us)
      : patient_(port, watch), bus_(patient_, timer, held_us) {}
  Bus& bus() { return bus_; }

 private:
  Patient patient_;
  Bus bus_;
};

}  // namespace verp::board
