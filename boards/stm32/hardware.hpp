#pragma once
#include "board.hpp"
#include "boards/stm32/ports.hpp"
#include "hal/chip/stm32/analog_input.hpp"
#include "hal/chip/stm32/brown_out.hpp"
#include "hal/chip/stm32/buzzer.hpp"
#include "hal/chip/stm32/memory_io.hpp"
#include "hal/chip/stm32/reset_cause.hpp"
#include "hal/chip/stm32/tick_timer.hpp"
#include "hal/chip/stm32/watchdog.hpp"
#include "robot_port.hpp"

/// The chip's drivers and their start-up. They are static, so that interrupts find them.
namespace verp::board {

using Io = stm32::MemoryIo;
using Timer = stm32::TickTimer<Io>;
template <auto& kWiring>
using KindOf = PortKind<std::remove_cvref_t<decltype(kWiring)>, Io, UsartKind, Timer>;
using RobotSide = RobotWiring<Io, UsartKind, Timer>;
using OperatorSide = KindOf<kOperatorPort>;
using Port = RobotSide::Port;
using OperatorPort = OperatorSide::Port;

using Battery = stm32::AnalogInput<Io, Timer>;

extern Timer timer;
extern Port robot_port;
extern OperatorPort operator_port;
extern Battery battery;
extern stm32::Buzzer<Io> buzzer;

struct Start {
  stm32::Clocks clocks;
  stm32::ResetCause cause = stm32::ResetCause::kUnknown;
  stm32::BrownOut brown_out = stm32::BrownOut::kUnknown;
  bool good = false;  ///< false: the timer does not count
};

/// Call once: clocks, pins, timer and interrupts. Ports are opened later.
Start start_hardware();
/// False: impossible rate. Waits milliseconds at most.
bool open_robot_port(const Start& start, std::uint32_t baud);
/// False: no clock or no answer. USB takes 25 ms.
bool open_operator_port(const Start& start);

}  // namespace verp::board
