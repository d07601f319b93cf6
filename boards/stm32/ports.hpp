#pragma once
#include <type_traits>

#include "boards/stm32/wiring.hpp"
#include "hal/chip/stm32/clock_gate.hpp"
#include "hal/chip/stm32/interrupts.hpp"
#include "hal/chip/stm32/otg_fs.hpp"
#include "hal/chip/stm32/usart.hpp"
#include "hal/chip/usb/cdc_acm.hpp"

/// The kinds of port in a board.hpp, with one interface.
namespace verp::board {

/// The driver of a kind of port, chosen by its wiring type.
template <class Wiring, class Io, class UsartKind, class Timer>
struct PortKind;

template <class Io, class UsartKind, class Timer>
struct PortKind<SerialPort, Io, UsartKind, Timer> {
  using Port = hal::stm32::Usart<Io, UsartKind, Timer>;

  static Port make(const SerialPort& port, hal::stm32::Family, Timer& timer) {
    return Port(port.wiring, timer);
  }
  static void connect(const SerialPort& port, std::uint8_t priority) {
    hal::stm32::enable_clock(Io{}, port.gate.enable_register, port.gate.mask);
    hal::stm32::enable_clock(Io{}, port.dma_gate.enable_register, port.dma_gate.mask);
    hal::stm32::Gpio<Io> gpio;
    gpio.alternate(port.transmit, port.function);
    gpio.alternate(port.receive, port.function, hal::stm32::gpio::kPullUp);
    hal::stm32::enable_interrupt(Io{}, port.interrupt, priority);
    hal::stm32::enable_interrupt(Io{}, port.dma_interrupt, priority);
  }
  static bool open(Port& port, const SerialPort& wiring, const hal::stm32::Clocks& clocks,
                   std::uint32_t baud) {
    return port.open(wiring.on_apb2 ? clocks.apb2_hz : clocks.apb1_hz, baud);
  }
  static bool open(Port& port, const SerialPort& wiring, const hal::stm32::Clocks& clocks) {
    return open(port, wiring, clocks, wiring.baud);
  }
};

template <class Io, class UsartKind, class Timer>
struct PortKind<UsbPort, Io, UsartKind, Timer> {
  using Port = hal::stm32::OtgFs<Io, hal::usb::CdcAcm, Timer>;

  /// Call once. The chip's unique number distinguishes two boards on one PC.
  static Port make(const UsbPort& port, hal::stm32::Family family, Timer& timer) {
    std::uint8_t number[hal::usb::kSerialBytes];
    Io io;
    std::uint32_t address = hal::stm32::limits(family).unique_id_address;
    for (std::uint8_t& byte : number) byte = io.read8(address++);
    static hal::usb::CdcAcm function(port.product, number);
    return Port(family, function, timer);
  }
  static void connect(const UsbPort& port, std::uint8_t priority) {
    hal::stm32::enable_clock(Io{}, hal::stm32::rcc::kAhb2enr, hal::stm32::rcc::kAhb2OtgFs);
    hal::stm32::Gpio<Io> gpio;
    gpio.alternate(port.minus, port.function);
    gpio.alternate(port.plus, port.function);
    if (port.senses_vbus) gpio.input({'A', 9}, hal::stm32::gpio::kPullNone);
    hal::stm32::enable_interrupt(Io{}, port.interrupt, priority);
  }
  static bool open(Port& port, const UsbPort& wiring, const hal::stm32::Clocks& clocks) {
    return port.open(clocks.sysclk_hz, wiring.senses_vbus);
  }
};

}  // namespace verp::board
