#include "hal/chip/stm32/analog_scan.hpp"

#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/adc_model.hpp"
#include "tests/support/stm32/gpio_model.hpp"

namespace verp::hal::stm32::test {
namespace {

/// OpenCR's wiring.
constexpr AnalogWiring kWiring = {.base = base::kAdc3,
                                  .mask = rcc::kApb2Adc3,
                                  .pin = {'C', 0},
                                  .channel = 10,
                                  .full_scale_mv = 18'810};

class AnalogDriver : public EachFamily {
 protected:
  AnalogDriver() { input.open(rig.clocks.apb2_hz); }
  /// Every 8 ms.
  std::uint32_t after(int polls) {
    std::uint32_t mv = 0;
    for (int i = 0; i < polls; ++i) {
      const std::uint64_t before_us = rig.timer.now_us();
      mv = input.poll_mv();
      EXPECT_LE(rig.timer.now_us() - before_us, 5u) << "no poll waits";
      rig.machine.advance(ms(8));
    }
    return mv;
  }
  Rig rig{GetParam()};
  model::AdcModel& adc_ = rig.machine.adc(3);
  AnalogInput<Io, Timer> input{kWiring, rig.timer, rig.machine.io()};
};
INSTANTIATE_TEST_SUITE_P(, AnalogDriver, kFamilies, name_of);

TEST_P(AnalogDriver, TellsTheVoltageAtTheWire) {
  for (const std::uint32_t mv : {18'800u, 12'600u, 11'100u, 9'000u, 5u}) {
    const auto count = static_cast<std::uint16_t>(mv * 4096 / kWiring.full_scale_mv);
    adc_.input[10] = count;
    adc_.input[0] = 4095;  // another channel's
    EXPECT_NEAR(after(150), mv, 6.0) << mv;
  }
  EXPECT_EQ(rig.machine.gpio('C').mode(0), 3u) << "an analog pin is no digital input";
  EXPECT_EQ(input.timeouts(), 0u);
}

TEST_P(AnalogDriver, OneSpikeMovesItLittle) {
  adc_.input[10] = 2048;
  const std::uint32_t calm_mv = after(100);
  adc_.input[10] = 0;
  after(1);
  adc_.input[10] = 2048;
  EXPECT_NEAR(after(2), calm_mv, 0.1 * calm_mv);
}

TEST_P(AnalogDriver, HasNothingToTellBeforeTheFirstConversion) {
  adc_.input[10] = 2048;
  EXPECT_EQ(input.poll_mv(), 0u);
  EXPECT_EQ(input.poll_mv(), 0u);
  EXPECT_GT(after(3), 9000u);
}

TEST_P(AnalogDriver, ConverterThatStopsIsCountedAndItsVoltageIsNotKept) {
  adc_.input[10] = 2048;
  after(10);
  adc_.conversion_stuck = true;
  EXPECT_EQ(after(5), 0u);
  EXPECT_GE(input.timeouts(), 2u);
  adc_.conversion_stuck = false;
  EXPECT_GT(after(5), 9000u);
}

TEST_P(AnalogDriver, WhereThereIsNoneNothingIsTouched) {
  AnalogInput<Io, Timer> none({}, rig.timer, rig.machine.io());
  none.open(rig.clocks.apb2_hz);
  EXPECT_EQ(none.poll_mv(), 0u);
}

/// Feet of boards/stm32/f4_ports.hpp.
constexpr ScanWiring kCells = {.base = base::kAdc1,
                               .mask = rcc::kApb2Adc1,
                               .pin = {{'C', 0}, {'C', 1}, {'C', 2}, {'C', 3}},
                               .channel = {10, 11, 12, 13}};

class ScanDriver : public EachFamily {
 protected:
  ScanDriver() { scan.open(rig.clocks.apb2_hz); }
  /// False: nothing new within 2 ms.
  bool fetch() {
    const std::uint64_t end_us = rig.timer.now_us() + 2000;
    while (rig.timer.now_us() < end_us) {
      const std::uint64_t before_us = rig.timer.now_us();
      if (scan.poll(counts)) return true;
      EXPECT_LE(rig.timer.now_us() - before_us, 5u) << "no poll waits";
      rig.machine.advance(us(1));
    }
    return false;
  }
  Rig rig{GetParam()};
  model::AdcModel& adc_ = rig.machine.adc(1);
  AnalogScan<Io, Timer> scan{kCells, rig.timer, rig.machine.io()};
  std::uint16_t counts[4] = {};
};
INSTANTIATE_TEST_SUITE_P(, ScanDriver, kFamilies, name_of);

TEST_P(ScanDriver, GivesSixteenTimesEachChannelsCount) {
  const std::uint16_t given[4] = {0, 100, 2048, 4095};
  for (int i = 0; i < 4; ++i) adc_.input[10 + i] = given[i];
  for (int times = 0; times < 3; ++times) {
    ASSERT_TRUE(fetch());
    for (int i = 0; i < 4; ++i) EXPECT_EQ(counts[i], 16 * given[i]) << i;
  }
  for (int i = 0; i < 4; ++i) EXPECT_EQ(rig.machine.gpio('C').mode(static_cast<unsigned>(i)), 3u);
}

TEST_P(ScanDriver, AStoppedConverterGivesNothingUntilItRunsAgain) {
  adc_.input[10] = 1000;
  ASSERT_TRUE(fetch());
  adc_.conversion_stuck = true;
  fetch();  // what had begun
  EXPECT_FALSE(fetch());
  adc_.conversion_stuck = false;
  adc_.input[10] = 3000;
  ASSERT_TRUE(fetch());
  EXPECT_EQ(counts[0], 16 * 3000) << "none of the sum before";
}

}  // namespace
}  // namespace verp::hal::stm32::test
