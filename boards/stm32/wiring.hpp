#pragma once
#include <cstdint>

#include "hal/chip/stm32/analog_scan.hpp"
#include "hal/chip/stm32/bxcan.hpp"
#include "hal/chip/stm32/clock.hpp"
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/spi_master.hpp"
#include "hal/chip/stm32/usart.hpp"

namespace verp::board {

using hal::stm32::Pin;

/// A peripheral's clock: RCC register and bit.
struct ClockGate {
  std::uint32_t enable_register = 0;
  std::uint32_t mask = 0;
};

struct SerialPort {
  hal::stm32::UsartWiring wiring;
  Pin transmit;
  Pin receive;
  std::uint32_t function = 0;  ///< alternate function of both pins
  ClockGate gate;
  ClockGate dma_gate;
  bool on_apb2 = false;  ///< otherwise on APB1
  unsigned interrupt = 0;
  unsigned dma_interrupt = 0;
  std::uint32_t baud = 0;  ///< operator's port only; the robot sets the servos'
};

/// A bxCAN on APB1, with a CAN transceiver.
struct CanPort {
  std::uint32_t base = 0;
  hal::stm32::CanFilterBanks filters;
  std::uint32_t clocks = 0;  ///< mask in APB1ENR, with that of the filters' bxCAN
  Pin transmit;
  Pin receive;
  std::uint32_t function = 0;    ///< alternate function of both pins
  unsigned first_interrupt = 0;  ///< transmission; both FIFOs and errors follow
};

struct UsbPort {
  Pin minus;
  Pin plus;
  std::uint32_t function = 0;  ///< alternate function of both pins
  bool senses_vbus = false;    ///< PA9 is wired to VBUS
  const char* product = "";    ///< name on the PC; ASCII, at most 24 characters
  static constexpr unsigned interrupt = hal::stm32::irq::kOtgFs;
  static constexpr unsigned dma_interrupt = interrupt;  ///< no other
};

/// A motion sensor of hal/chip/invensense; {}: none.
struct ImuPort {
  hal::stm32::SpiWiring wiring;
  bool on_apb2 = false;

  constexpr bool exists() const { return wiring.base != 0; }
};

/// A foot's force cells: front left and right, back left and right.
struct FootPort {
  hal::stm32::ScanWiring cells;
  Pin right;  ///< joined to ground: the right foot
};

struct Button {
  Pin pin;
  bool pressed_high = false;
};

}  // namespace verp::board
