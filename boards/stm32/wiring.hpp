#pragma once
#include <cstdint>

#include "hal/chip/stm32/analog_input.hpp"
#include "hal/chip/stm32/bxcan.hpp"
#include "hal/chip/stm32/clock.hpp"
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/spi_master.hpp"
#include "hal/chip/stm32/usart.hpp"

/// The words in which a board.hpp says how its STM32 is connected.
namespace verp::board {

using hal::stm32::Pin;

/// A peripheral's clock: the register of the clock controller that has its bit.
struct ClockGate {
  std::uint32_t enable_register = 0;
  std::uint32_t mask = 0;
};

/// A serial port: pins, and which interrupts and DMA stream the chip has for it.
struct SerialPort {
  hal::stm32::UsartWiring wiring;
  Pin transmit;
  Pin receive;
  std::uint32_t function = 0;  ///< alternate function of both pins
  ClockGate gate;
  ClockGate dma_gate;
  bool on_apb2 = false;  ///< else on APB1
  unsigned interrupt = 0;
  unsigned dma_interrupt = 0;
  std::uint32_t baud = 0;  ///< of the operator's port; the servos' is the robot's
};

/// A bxCAN, on APB1. Its pins go to a CAN transceiver.
struct CanPort {
  std::uint32_t base = 0;
  hal::stm32::CanFilterBanks filters;
  std::uint32_t clocks = 0;  ///< mask in APB1ENR, with that of who keeps its filters
  Pin transmit;
  Pin receive;
  std::uint32_t function = 0;    ///< alternate function of both pins
  unsigned first_interrupt = 0;  ///< transmission; reception of either FIFO and errors follow
};

/// USB full speed, a serial port to the PC it is plugged into.
struct UsbPort {
  Pin minus;
  Pin plus;
  std::uint32_t function = 0;  ///< alternate function of both pins
  bool senses_vbus = false;    ///< PA9 is wired to the connector's VBUS
  const char* product = "";    ///< what the PC shows; ASCII, 24 characters at most
  static constexpr unsigned interrupt = hal::stm32::irq::kOtgFs;
  static constexpr unsigned dma_interrupt = interrupt;  ///< it has no other
};

/// A motion sensor of hal/chip/invensense on the board; {}: there is none.
struct ImuPort {
  hal::stm32::SpiWiring wiring;
  bool on_apb2 = false;

  constexpr bool exists() const { return wiring.base != 0; }
};

struct Button {
  Pin pin;
  bool pressed_high = false;
};

}  // namespace verp::board
