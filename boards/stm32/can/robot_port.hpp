#pragma once
#include <cstdint>

#include "boards/stm32/wiring.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "firmware/app/operator_node.hpp"
#include "hal/chip/stm32/bxcan.hpp"
#include "hal/chip/stm32/clock_gate.hpp"

/// The port to a robot on the board's bxCAN. Alternative: boards/stm32/serial.
namespace verp::board {

constexpr bool drives(BusProtocol protocol) {
  return protocol == BusProtocol::kCia402;
}
inline constexpr unsigned kRobotInterrupts[] = {
    kCanPort.first_interrupt, kCanPort.first_interrupt + 1, kCanPort.first_interrupt + 2,
    kCanPort.first_interrupt + 3};
static_assert(hal::stm32::bxcan_timing(kClockPlan, 1'000'000).bitrate == 1'000'000);

template <class Io, class UsartKind, class Timer>
struct RobotWiring {
  using Port = hal::stm32::BxCan<Io, Timer>;

  static Port make(Timer& timer, Io io = {}) {
    return Port(kCanPort.base, timer, io, kCanPort.filters);
  }
  static void connect(std::uint8_t priority, Io io = {}) {
    hal::stm32::enable_clock(io, hal::stm32::rcc::kApb1enr, kCanPort.clocks);
    hal::stm32::Gpio<Io> gpio(io);
    gpio.alternate(kCanPort.transmit, kCanPort.function);
    gpio.alternate(kCanPort.receive, kCanPort.function, hal::stm32::gpio::kPullUp);
    for (const unsigned each : kRobotInterrupts) {
      hal::stm32::enable_interrupt(io, each, priority);
    }
  }
  /// False: the clock is not the crystal or cannot make this rate. Accepts all identifiers: a
  /// bring-up listens for any other controller.
  static bool open(Port& port, const hal::stm32::Clocks& clocks, std::uint32_t baud) {
    hal::stm32::BxCanTiming timing;
    return hal::stm32::choose_bxcan_timing(clocks.apb1_hz, baud, timing) &&
           port.open(clocks, timing);
  }
  /// Resets every node, which removes torque. Three times, since there is no reply.
  static void release(Port& port, BusProtocol = BusProtocol::kCia402) {
    for (int times = 0; times < 3; ++times) {
      port.send(canopen::nmt_frame(canopen::NmtCommand::kResetNode, 0));
    }
  }
};

/// A node that publishes each tick; the loop uses it as its port.
template <class Port>
class RobotNode {
 public:
  using LoopPort = app::OperatorNode;
  RobotNode(Port& port, const Params& params, app::OperatorRegisters& registers,
            app::Images& images)
      : node_(port, params, registers, images) {}
  LoopPort& port() { return node_; }
  void tell(const Inputs& inputs) { node_.tell(inputs); }

 private:
  LoopPort node_;
};

template <class Port, class Idle>
using LockstepOn = app::LockstepCan<Port, Idle>;

/// The far end is real drives. `Watch` is called every few milliseconds of a longer wait.
template <class Port, class Timer, class Watch>
class RealTimeOn {
 public:
  class Bus final : public hal::CanBus {
   public:
    Bus(Port& port, Watch watch) : port_(port), watch_(watch) {}
    bool send(const CanFrame& frame) override {
      const std::uint64_t now_us = port_.now_us();
      const bool accepted = port_.send(frame);
      if (accepted) sent_us_ = now_us;
      return accepted;
    }
    bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
      for (;;) {
        watch_();
        const std::uint64_t slice_us = port_.now_us() - sent_us_ + kSlice_us;
        const bool last = slice_us >= timeout_us;
        if (port_.poll(frame, last ? timeout_us : static_cast<std::uint32_t>(slice_us)))
          return true;
        if (last) return false;
      }
    }
    std::uint64_t now_us() override { return port_.now_us(); }
    hal::CanErrors errors() const override { return port_.errors(); }

   private:
    static constexpr std::uint64_t kSlice_us = 5000;

    Port& port_;
    Watch watch_;
    std::uint64_t sent_us_ = 0;
  };

  RealTimeOn(Port& port, const Timer&, Watch watch, std::uint32_t) : bus_(port, watch) {}
  Bus& bus() { return bus_; }

 private:
  Bus bus_;
};

}  // namespace verp::board
