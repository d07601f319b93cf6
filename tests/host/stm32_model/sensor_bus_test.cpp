#include <gtest/gtest.h>

#include "hal/chip/stm32/registers/i2c.hpp"
#include "hal/chip/stm32/registers/spi.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/i2c_model.hpp"
#include "tests/support/stm32/imu_device.hpp"
#include "tests/support/stm32/spi_model.hpp"

namespace verp::hal::stm32::model {
namespace {

constexpr std::uint32_t kS = base::kSpi1;

/// An MPU-9250 on SPI1 at 1 MHz, chip select at PA4.
struct SpiLine {
  explicit SpiLine(Family family, ImuKind kind = ImuKind::kMpu9250, std::uint32_t cr1_mode = 3)
      : machine(family), io(machine.io()), spi(machine.spi(1)), imu(kind) {
    enable(io, rcc::kAhb1enr, rcc::kAhb1GpioA);
    enable(io, rcc::kApb2enr, rcc::kApb2Spi1);
    const std::uint32_t port = base::gpio('A');
    spi.attach(imu, machine.gpio('A'), 4);
    io.write32(port + gpio::kBsrr, 1u << 4);
    modify32(io, port + gpio::kModer, 3u << 8, gpio::kModeOutput << 8);
    if (family == Family::kF746) io.write32(kS + spi::kCr2, spi::kCr2Ds8BitF7 | spi::kCr2FrxthF7);
    const std::uint32_t cr1 =
        cr1_mode | spi::kCr1Mstr | 3u << spi::kCr1BrShift | spi::kCr1Ssm | spi::kCr1Ssi;
    io.write32(kS + spi::kCr1, cr1);
    io.write32(kS + spi::kCr1, cr1 | spi::kCr1Spe);
  }
  void select(bool on) { io.write32(base::gpio('A') + gpio::kBsrr, on ? 1u << 20 : 1u << 4); }
  std::uint8_t exchange(std::uint8_t out) {
    io.write8(kS + spi::kDr, out);
    if (!wait_set(machine, kS + spi::kSr, spi::kSrRxne, us(100))) return 0;
    return io.read8(kS + spi::kDr);
  }
  std::uint8_t read(std::uint8_t address) {
    select(true);
    exchange(static_cast<std::uint8_t>(address | 0x80));
    const std::uint8_t value = exchange(0);
    select(false);
    return value;
  }
  void write(std::uint8_t address, std::uint8_t value) {
    select(true);
    exchange(address);
    exchange(value);
    select(false);
  }
  Machine machine;
  ModelIo io;
  SpiModel& spi;
  ImuDevice imu;
};

TEST(Spi, ReadsTheIdentityOfTheSensorOnEveryFamily) {
  for (const Family family : kFamilies) {
    SpiLine mpu(family);
    EXPECT_EQ(mpu.read(0x75), 0x71);
    EXPECT_EQ(mpu.machine.violations_text(), "");
    SpiLine icm(family, ImuKind::kIcm20648);
    EXPECT_EQ(icm.read(0x00), 0xE0);
    EXPECT_EQ(icm.machine.violations_text(), "");
  }
}

TEST(Spi, AByteTakesEightClocksAndBsyLastsAsLong) {
  SpiLine line(Family::kF405);
  const Time before = line.machine.now();
  line.io.write8(kS + spi::kDr, 0);
  EXPECT_NE(line.io.read32(kS + spi::kSr) & spi::kSrBsy, 0u);
  EXPECT_TRUE(wait_clear(line.machine, kS + spi::kSr, spi::kSrBsy, us(100)));
  EXPECT_NEAR(static_cast<double>(line.machine.now() - before), static_cast<double>(us(8)), 2e6);
}

TEST(Spi, UnreadBytesOverrunAndClearByDrThenSr) {
  for (const Family family : kFamilies) {
    SpiLine line(family);
    for (int i = 0; i < 6; ++i) {
      wait_set(line.machine, kS + spi::kSr, spi::kSrTxe, us(100));
      line.io.write8(kS + spi::kDr, 0x80);
    }
    line.machine.advance(us(100));
    EXPECT_NE(line.io.read32(kS + spi::kSr) & spi::kSrOvr, 0u);
    line.io.read8(kS + spi::kDr);
    line.io.read32(kS + spi::kSr);
    EXPECT_EQ(line.io.read32(kS + spi::kSr) & spi::kSrOvr, 0u);
  }
}

TEST(Spi, WideAccessesOfTheNewKindPackTwoBytes) {
  SpiLine line(Family::kF746);
  line.io.write32(kS + spi::kDr, 0x80);
  line.machine.advance(us(50));
  EXPECT_EQ(line.spi.exchanged(), 2u);
}

TEST(Spi, AStuckShifterAWrongModeAndAnEarlyDeselectAreSeen) {
  SpiLine stuck(Family::kF446);
  stuck.spi.busy_stuck = true;
  stuck.io.write8(kS + spi::kDr, 0);
  EXPECT_FALSE(wait_clear(stuck.machine, kS + spi::kSr, spi::kSrBsy, ms(1)));
  SpiLine wrong(Family::kF405, ImuKind::kMpu9250, spi::kCr1Cpha);
  wrong.select(true);
  wrong.exchange(0xF5);
  EXPECT_TRUE(one_violation(wrong.machine, "clock mode"));
  wrong.io.write8(kS + spi::kDr, 0);
  wrong.select(false);
  EXPECT_NE(wrong.machine.violations_text().find("chip select released"), std::string::npos);
}

TEST(Imu, SleepsWakesSamplesAtItsRateAndGivesEachSampleWhole) {
  SpiLine line(Family::kF405);
  line.imu.motion({100, -200, 300}, {-1, 2, 16384});
  line.write(0x6B, 0x40);
  line.read(0x3A);  // it was awake before
  line.machine.advance(ms(10));
  EXPECT_EQ(line.read(0x3A) & 1, 0);
  line.write(0x19, 4);  // 200 Hz
  line.write(0x6B, 0x01);
  line.machine.advance(ms(4));
  EXPECT_EQ(line.read(0x3A) & 1, 0);
  line.machine.advance(ms(2));
  EXPECT_EQ(line.read(0x3A) & 1, 1);
  EXPECT_EQ(line.read(0x3A) & 1, 0);  // reading it clears it
  line.select(true);
  line.exchange(0x3B | 0x80);
  std::uint8_t data[14];
  for (std::uint8_t& byte : data) byte = line.exchange(0);
  line.select(false);
  const auto word = [&](int i) { return static_cast<std::int16_t>(data[i] << 8 | data[i + 1]); };
  EXPECT_EQ(word(0), -1);
  EXPECT_EQ(word(4), 16384);
  EXPECT_EQ(word(8), 100);
  EXPECT_EQ(word(10), -200);
  EXPECT_EQ(line.machine.violations_text(), "");
}

TEST(Imu, ResetTakesItsTimeAndClearsSettings) {
  SpiLine line(Family::kF405);
  line.write(0x1B, 0x18);
  line.write(0x6B, 0x80);
  EXPECT_EQ(line.read(0x75), 0);
  line.machine.advance(ms(101));
  EXPECT_EQ(line.read(0x75), 0x71);
  EXPECT_EQ(line.read(0x1B), 0);
}

constexpr std::uint32_t kI = base::kI2c1;

/// I2C1 at 400 kHz with a sensor at 0x68 and its pins at PB8 and PB9.
struct I2cLine {
  explicit I2cLine(Family family) : machine(family), io(machine.io()), imu(ImuKind::kMpu9250) {
    machine.i2c(1).bus().attach(imu);
    enable(io, rcc::kAhb1enr, rcc::kAhb1GpioA << 1);
    enable(io, rcc::kApb1enr, rcc::kApb1I2c1);
    machine.i2c(1).bus().wire(machine.gpio('B'), 8, 9);
    if (family == Family::kF746) {
      io.write32(kI + i2c_v2::kTimingr, 1u << 28 | 9u << 8 | 9u);
      io.write32(kI + i2c_v2::kCr1, i2c_v2::kCr1Pe);
    } else {
      io.write32(kI + i2c_v1::kCr2, 16);
      io.write32(kI + i2c_v1::kCcr, i2c_v1::kCcrFs | 14);
      io.write32(kI + i2c_v1::kTrise, 5);
      io.write32(kI + i2c_v1::kCr1, i2c_v1::kCr1Pe);
    }
  }
  Machine machine;
  ModelIo io;
  ImuDevice imu;
};

/// As RM0090 27.3.3 has it: write the register's address, repeated start, read one byte.
bool read_v1(I2cLine& line, std::uint8_t device, std::uint8_t address, std::uint8_t& value) {
  using namespace i2c_v1;
  ModelIo& io = line.io;
  const auto wait = [&](std::uint32_t mask) {
    return wait_set(line.machine, kI + kSr1, mask, us(200));
  };
  modify32(io, kI + kCr1, 0, kCr1Start | kCr1Ack);
  if (!wait(kSr1Sb)) return false;
  io.write32(kI + kDr, device * 2u);
  if (!wait(kSr1Addr)) return false;
  io.read32(kI + kSr2);
  io.write32(kI + kDr, address);
  if (!wait(kSr1Btf)) return false;
  modify32(io, kI + kCr1, 0, kCr1Start);
  if (!wait(kSr1Sb)) return false;
  io.write32(kI + kDr, device * 2u + 1u);
  if (!wait(kSr1Addr)) return false;
  modify32(io, kI + kCr1, kCr1Ack, 0);
  io.read32(kI + kSr2);
  modify32(io, kI + kCr1, 0, kCr1Stop);
  if (!wait(kSr1Rxne)) return false;
  value = static_cast<std::uint8_t>(io.read32(kI + kDr));
  return wait_clear(line.machine, kI + kSr2, kSr2Busy, us(200));
}

bool read_v2(I2cLine& line, std::uint8_t device, std::uint8_t address, std::uint8_t& value) {
  using namespace i2c_v2;
  ModelIo& io = line.io;
  const auto wait = [&](std::uint32_t mask) {
    return wait_set(line.machine, kI + kIsr, mask, us(200));
  };
  io.write32(kI + kCr2, device * 2u | 1u << kCr2NbytesShift | kCr2Start);
  if (!wait(kIsrTxis)) return false;
  io.write32(kI + kTxdr, address);
  if (!wait(kIsrTc)) return false;
  io.write32(kI + kCr2, device * 2u | kCr2RdWrn | 1u << kCr2NbytesShift | kCr2Autoend | kCr2Start);
  if (!wait(kIsrRxne)) return false;
  value = static_cast<std::uint8_t>(io.read32(kI + kRxdr));
  if (!wait(kIsrStopf)) return false;
  io.write32(kI + kIcr, kIsrStopf);
  return true;
}

bool read(I2cLine& line, std::uint8_t device, std::uint8_t address, std::uint8_t& value) {
  return line.machine.family() == Family::kF746 ? read_v2(line, device, address, value)
                                                : read_v1(line, device, address, value);
}

TEST(I2c, ReadsARegisterAsTheManualSays) {
  for (const Family family : kFamilies) {
    I2cLine line(family);
    std::uint8_t value = 0;
    EXPECT_TRUE(read(line, 0x68, 0x75, value));
    EXPECT_EQ(value, 0x71);
    EXPECT_TRUE(read(line, 0x68, 0x6B, value));
    EXPECT_EQ(value, 0x01);
    EXPECT_EQ(line.machine.violations_text(), "");
  }
}

TEST(I2c, NobodyAtAnAddressIsNoAcknowledge) {
  for (const Family family : kFamilies) {
    I2cLine line(family);
    std::uint8_t value = 0;
    EXPECT_FALSE(read(line, 0x33, 0x75, value));
    const bool v2 = family == Family::kF746;
    const std::uint32_t flags = line.io.read32(kI + (v2 ? i2c_v2::kIsr : i2c_v1::kSr1));
    EXPECT_NE(flags & (v2 ? i2c_v2::kIsrNackf : i2c_v1::kSr1Af), 0u);
  }
}

TEST(I2c, AHeldDataLineStopsEverythingUntilItWasClockedFree) {
  for (const Family family : kFamilies) {
    I2cLine line(family);
    line.machine.i2c(1).bus().hold_data(5);
    std::uint8_t value = 0;
    EXPECT_FALSE(read(line, 0x68, 0x75, value));
    const std::uint32_t port = base::gpio('B');
    modify32(line.io, port + gpio::kOtyper, 0, 1u << 8);
    line.io.write32(port + gpio::kBsrr, 1u << 8);
    modify32(line.io, port + gpio::kModer, 0, gpio::kModeOutput << 16);
    int pulses = 0;
    while ((line.io.read32(port + gpio::kIdr) & 1u << 9) == 0 && pulses < 9) {
      line.io.write32(port + gpio::kBsrr, 1u << 24);
      line.io.write32(port + gpio::kBsrr, 1u << 8);
      ++pulses;
    }
    EXPECT_EQ(pulses, 5);
    EXPECT_FALSE(line.machine.i2c(1).bus().data_held());
  }
}

TEST(I2c, BusErrorsAndLostArbitrationAreFlagged) {
  for (const Family family : kFamilies) {
    const bool v2 = family == Family::kF746;
    const std::uint32_t status = kI + (v2 ? i2c_v2::kIsr : i2c_v1::kSr1);
    I2cLine line(family);
    line.machine.i2c(1).bus_errors = 1;
    std::uint8_t value = 0;
    EXPECT_FALSE(read(line, 0x68, 0x75, value));
    EXPECT_NE(line.io.read32(status) & (v2 ? i2c_v2::kIsrBerr : i2c_v1::kSr1Berr), 0u);
    I2cLine lost(family);
    lost.machine.i2c(1).arbitration_losses = 1;
    EXPECT_FALSE(read(lost, 0x68, 0x75, value));
    EXPECT_NE(lost.io.read32(status) & (v2 ? i2c_v2::kIsrArlo : i2c_v1::kSr1Arlo), 0u);
  }
}

}  // namespace
}  // namespace verp::hal::stm32::model
