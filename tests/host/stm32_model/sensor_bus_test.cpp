#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hal/chip/stm32/registers/spi.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/imu_device.hpp"
#include "tests/support/stm32/spi_model.hpp"

namespace verp::hal::stm32::model {
namespace {

constexpr std::uint32_t kS = base::kSpi1;

/// At 1 MHz, chip select PA4.
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
  line.read(0x3A);  // awake before
  line.machine.advance(ms(10));
  EXPECT_EQ(line.read(0x3A) & 1, 0);
  line.write(0x19, 4);  // 200 Hz
  line.write(0x6B, 0x01);
  line.machine.advance(ms(4));
  EXPECT_EQ(line.read(0x3A) & 1, 0);
  line.machine.advance(ms(2));
  EXPECT_EQ(line.read(0x3A) & 1, 1);
  EXPECT_EQ(line.read(0x3A) & 1, 0);  // cleared by reading
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

struct Fifo {
  std::size_t size() { return std::size_t{line.read(size_at)} << 8 | line.read(size_at + 1); }
  std::vector<std::uint8_t> take(std::size_t count) {
    std::vector<std::uint8_t> bytes;
    line.select(true);
    line.exchange(static_cast<std::uint8_t>((size_at + 2) | 0x80));
    while (bytes.size() < count) bytes.push_back(line.exchange(0));
    line.select(false);
    return bytes;
  }
  SpiLine& line;
  std::uint8_t size_at;
};

TEST(Imu, FifoTakesWhatIsSelectedStreamsItAndIsEmptiedOnlyWhileOff) {
  SpiLine line(Family::kF405);
  Fifo fifo{line, 0x72};
  line.imu.motion({0x102, 0x304, 0x506}, {0x708, 0x90A, 0xB0C});
  line.write(0x23, 0x48);  // acceleration, rate about x
  line.machine.advance(ms(3));
  EXPECT_EQ(fifo.size(), 0u);
  line.write(0x6A, 0x40);
  line.machine.advance(us(2500));
  line.write(0x6A, 0x00);
  ASSERT_EQ(fifo.size() % 8, 0u);
  ASSERT_GE(fifo.size(), 16u);
  const std::vector<std::uint8_t> one = {7, 8, 9, 10, 11, 12, 1, 2};
  EXPECT_EQ(fifo.take(8), one);
  EXPECT_EQ(fifo.take(8), one);
  line.write(0x6A, 0x44);
  EXPECT_NE(line.read(0x6A) & 0x40, 0) << "clears itself, and the rest stays";
  line.machine.advance(ms(2));
  EXPECT_GT(fifo.size(), 0u);
  line.write(0x6A, 0x04);
  EXPECT_EQ(fifo.size(), 0u);
  EXPECT_EQ(line.machine.violations_text(), "");
}

TEST(Imu, FullFifoLosesBytesAndTellsIt) {
  for (const std::uint8_t mode :
       {std::uint8_t{0x00}, std::uint8_t{0x40}}) {  // the oldest; the newest
    SpiLine line(Family::kF405);
    Fifo fifo{line, 0x72};
    line.write(0x1A, mode);
    line.write(0x23, 0x78);
    line.write(0x6A, 0x40);
    line.imu.motion({1, 1, 1}, {1, 1, 1});
    line.machine.advance(ms(40));
    EXPECT_EQ(line.read(0x3A) & 0x10, 0);
    line.imu.motion({2, 2, 2}, {2, 2, 2});
    line.machine.advance(ms(60));
    EXPECT_NE(line.read(0x3A) & 0x10, 0);
    EXPECT_EQ(fifo.size(), 512u);
    const std::vector<std::uint8_t> bytes = fifo.take(512);
    EXPECT_EQ(bytes.back(), 2) << "the last is cut in its midst";
    EXPECT_EQ(std::count(bytes.begin(), bytes.end(), 1) >= 19 * 6, mode != 0);
  }
}

TEST(Imu, IcmHoldsItsFifoEmptyUntilToldOtherwise) {
  SpiLine line(Family::kF746, ImuKind::kIcm20648);
  Fifo fifo{line, 0x70};
  line.write(0x06, 0x01);
  line.write(0x67, 0x1E);
  line.write(0x03, 0x40);
  line.machine.advance(ms(5));
  EXPECT_GE(fifo.size(), 48u);
  line.write(0x68, 0x1F);
  line.machine.advance(ms(5));
  EXPECT_EQ(fifo.size(), 0u);
  line.write(0x68, 0x00);
  line.machine.advance(ms(5));
  EXPECT_GE(fifo.size(), 48u);
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

}  // namespace
}  // namespace verp::hal::stm32::model
