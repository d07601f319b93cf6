#pragma once
#include "hal/chip/stm32/gpio.hpp"
#include "hal/chip/stm32/otg_fs.hpp"
#include "hal/chip/usb/cdc_acm.hpp"
#include "tests/support/stm32/rig.hpp"
#include "tests/support/stm32/serial_host.hpp"

namespace verp::hal::stm32::test {

inline constexpr std::uint8_t kChipNumber[usb::kSerialBytes] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10};

struct UsbRig : Rig {
  static constexpr std::size_t kRing = 512;
  using Port = OtgFs<Io, usb::CdcAcm, Timer, kRing>;

  explicit UsbRig(Family family) : Rig(family), port(family, function, timer, machine.io()) {
    enable_clock(machine.io(), rcc::kAhb2enr, rcc::kAhb2OtgFs);
    Gpio<Io> gpio(machine.io());
    gpio.alternate({'A', 11}, 10);
    gpio.alternate({'A', 12}, 10);
    machine.attach(irq::kOtgFs, [this] { port.on_interrupt(); });
    enable_interrupt(machine.io(), irq::kOtgFs, 8);
  }
  bool open(bool sense_vbus = false) { return port.open(clocks.sysclk_hz, sense_vbus); }

  usb::CdcAcm function{"a robot", kChipNumber};
  Port port;
  model::SerialHost host{machine};
};

}  // namespace verp::hal::stm32::test
