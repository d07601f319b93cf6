#include "hal/chip/stm32/analog_input.hpp"

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

}  // namespace
}  // namespace verp::hal::stm32::test
