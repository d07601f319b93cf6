#pragma once
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/stm32/spi_master.hpp"
#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/imu_device.hpp"
#include "tests/support/stm32/rig.hpp"
#include "tests/support/stm32/spi_model.hpp"

/// A motion sensor on SPI1 with OpenCR's pins.
namespace verp::hal::stm32::test {

using Spi = SpiMaster<Io, Timer>;
inline constexpr SpiWiring kSpiWiring = {.base = base::kSpi1,
                                         .enable_register = rcc::kApb2enr,
                                         .mask = rcc::kApb2Spi1,
                                         .clock = {'A', 5},
                                         .data_in = {'A', 6},
                                         .data_out = {'B', 5},
                                         .select = {'A', 4},
                                         .function = 5};

struct ImuRig {
  explicit ImuRig(Family family, model::ImuKind kind = model::ImuKind::kMpu9250,
                  const invensense::Ranges& ranges = {})
      : rig(family), device(kind), imu(spi, rig.timer, ranges) {
    rig.machine.spi(1).attach(device, rig.machine.gpio('A'), 4);
    rig.machine.spi(1).wire(rig.machine.gpio('A'), 5, 5);
    rig.machine.spi(1).wire(rig.machine.gpio('A'), 6, 5);
    rig.machine.spi(1).wire(rig.machine.gpio('B'), 5, 5);
    spi.open(rig.clocks.apb2_hz);
  }
  ~ImuRig() { EXPECT_EQ(device.violations(), 0u) << "against the chip's data sheet"; }

  ImuStatus read() {
    const std::uint64_t before_us = rig.timer.now_us();
    const ImuStatus status = imu.read(sample);
    EXPECT_LE(rig.timer.now_us() - before_us, kImuMaxWait_us);
    return status;
  }
  /// Reads every 8 ms until there is a sample, at most for a second.
  bool starts() {
    for (int tick = 0; tick < 125; ++tick) {
      if (read() == ImuStatus::kFresh) return true;
      rig.machine.advance(ms(8));
    }
    return false;
  }

  Rig rig;
  model::ImuDevice device;
  Spi spi{rig.machine.family(), kSpiWiring, rig.timer, rig.machine.io()};
  invensense::MotionSensor<Spi, Timer> imu;
  ImuSample sample;
};

}  // namespace verp::hal::stm32::test
