#include "hal/chip/stm32/spi_master.hpp"

#include <vector>

#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/imu_rig.hpp"
#include "tests/support/stm32/spi_model.hpp"

namespace verp::hal::stm32::test {
namespace {

/// Each byte's complement, one later.
class Echo : public model::SpiDevice {
 public:
  std::uint32_t most_hz = 10'000'000;
  std::vector<std::uint8_t> heard;
  int selections = 0;

  void select(bool selected, model::Time) override { selections += selected ? 1 : 0; }
  std::uint8_t exchange(std::uint8_t out, model::Time) override {
    const std::uint8_t in = next_;
    next_ = static_cast<std::uint8_t>(~out);
    heard.push_back(out);
    return in;
  }
  bool takes_mode(unsigned mode) const override { return mode == 3; }
  std::uint32_t max_hz() const override { return most_hz; }

 private:
  std::uint8_t next_ = 0x55;
};

class SpiDriver : public EachFamily {
 protected:
  SpiDriver() {
    model_.attach(echo, rig.machine.gpio('A'), 4);
    model_.wire(rig.machine.gpio('A'), 5, 5);
    model_.wire(rig.machine.gpio('A'), 6, 5);
    model_.wire(rig.machine.gpio('B'), 5, 5);
    spi.open(rig.clocks.apb2_hz);
  }
  bool exchange(std::size_t size = 4, std::uint32_t max_hz = 1'000'000) {
    static constexpr std::uint8_t kOut[16] = {1, 2,  3,  4,  5,  6,  7,  8,
                                              9, 10, 11, 12, 13, 14, 15, 16};
    return spi.exchange(kOut, in, size, max_hz);
  }
  void expect_works() {
    EXPECT_TRUE(exchange(4));
    EXPECT_EQ(in[1], 0xFE);
    EXPECT_EQ(in[3], 0xFC);
  }
  Rig rig{GetParam()};
  model::SpiModel& model_ = rig.machine.spi(1);
  Echo echo;
  Spi spi{GetParam(), kSpiWiring, rig.timer, rig.machine.io()};
  std::uint8_t in[16] = {};
};
INSTANTIATE_TEST_SUITE_P(, SpiDriver, kFamilies, name_of);

TEST_P(SpiDriver, CarriesBytesBothWaysInOrder) {
  ASSERT_TRUE(exchange(8));
  EXPECT_EQ(echo.heard, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(in[0], 0x55);
  for (int i = 1; i < 8; ++i) EXPECT_EQ(in[i], static_cast<std::uint8_t>(~i)) << i;
  EXPECT_EQ(echo.selections, 1);
  EXPECT_TRUE(rig.machine.gpio('A').level(4)) << "the device is let go";
}

// Rig reports violations of the device's highest clock.
TEST_P(SpiDriver, IsAsFastAsTheDeviceBearsAndTheDividersAllow) {
  for (const std::uint32_t most_hz : {330'000u, 1'000'000u, 7'000'000u, 20'000'000u, 60'000'000u}) {
    echo.most_hz = most_hz;
    ASSERT_TRUE(exchange(4, most_hz)) << most_hz;
    EXPECT_LE(model_.clock_hz(), most_hz);
    EXPECT_TRUE(2 * model_.clock_hz() > most_hz || model_.clock_hz() == rig.clocks.apb2_hz / 2)
        << most_hz << ": " << model_.clock_hz();
  }
}

TEST_P(SpiDriver, ShifterThatSticksCostsOneExchangeAndABoundedTime) {
  model_.busy_stuck = true;
  const std::uint64_t before_us = rig.timer.now_us();
  EXPECT_FALSE(exchange(16, 1'000'000));
  EXPECT_LE(rig.timer.now_us() - before_us, 2u * 16 * 8 * 2 + Spi::kSlack_us + 5);
  EXPECT_EQ(spi.errors().timeouts, 1u);
  EXPECT_TRUE(rig.machine.gpio('A').level(4));
  model_.busy_stuck = false;
  expect_works();
}

TEST_P(SpiDriver, BytesNobodyFetchedAreCountedAndNotTakenForAnswers) {
  ASSERT_TRUE(exchange(1));
  for (int i = 0; i < 8; ++i) {
    rig.machine.io().write8(base::kSpi1 + spi::kDr, 0xAA);
    rig.machine.advance(us(20));
  }
  rig.machine.advance(us(20));
  expect_works();
  EXPECT_EQ(spi.errors().overruns, 1u);
}

TEST_P(SpiDriver, OverrunWithinAnExchangeFailsIt) {
  rig.machine.at(rig.machine.now() + us(30), [this] { model_.overrun_next = true; });
  EXPECT_FALSE(exchange(16));
  EXPECT_EQ(spi.errors().overruns, 1u);
  EXPECT_EQ(spi.errors().timeouts, 0u);
  expect_works();
}

// The hardware reports another master.
TEST_P(SpiDriver, ModeFaultFailsTheExchangeAndIsUndone) {
  const auto fault = [this] {
    const std::uint32_t cr1 = rig.machine.io().read32(base::kSpi1 + spi::kCr1);
    rig.machine.io().write32(base::kSpi1 + spi::kCr1, cr1 & ~spi::kCr1Ssi);
  };
  ASSERT_TRUE(exchange());
  fault();
  expect_works();
  EXPECT_EQ(spi.errors().mode_faults, 1u);
  rig.machine.at(rig.machine.now() + us(30), fault);
  EXPECT_FALSE(exchange(16));
  rig.machine.forget_violations();  // the test stopped the busy peripheral
  EXPECT_EQ(spi.errors().mode_faults, 2u);
  expect_works();
}

}  // namespace
}  // namespace verp::hal::stm32::test
