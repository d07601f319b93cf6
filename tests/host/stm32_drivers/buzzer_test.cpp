#include "hal/chip/stm32/buzzer.hpp"

#include <vector>

#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/gpio_model.hpp"

namespace verp::hal::stm32::test {
namespace {

class BuzzerDriver : public EachFamily {
 protected:
  BuzzerDriver() {
    rig.machine.attach(irq::kTim3, [this] { buzzer.on_interrupt(); });
    enable_interrupt(rig.machine.io(), irq::kTim3, 12);
    buzzer.open(rig.clocks.apb1_timer_hz);
    rig.machine.gpio('F').on_change([this](unsigned pin, bool level) {
      if (pin != 14) return;
      high = level;
      turns.push_back(rig.machine.now());
    });
  }
  std::uint64_t period_us() const {
    return (turns.back() - turns.front()) / (turns.size() - 1) * 2 / us(1);
  }
  Rig rig{GetParam()};
  Buzzer<Io> buzzer{{'F', 14}, rig.machine.io()};
  std::vector<model::Time> turns;
  bool high = false;
};
INSTANTIATE_TEST_SUITE_P(, BuzzerDriver, kFamilies, name_of);

TEST_P(BuzzerDriver, SoundsAsAskedAndEnds) {
  struct Tone {
    std::uint32_t hz, ms;
  };
  for (const Tone tone : {Tone{500, 400}, Tone{2000, 80}, Tone{4000, 10}, Tone{20, 200}}) {
    turns.clear();
    buzzer.sound(tone.hz, tone.ms);
    rig.machine.advance(ms(tone.ms + 100));
    ASSERT_GT(turns.size(), 4u);
    EXPECT_NEAR(static_cast<double>(period_us()), 1e6 / tone.hz, 5.0);
    EXPECT_NEAR(static_cast<double>((turns.back() - turns.front()) / us(1)), 1e3 * tone.ms,
                1.2e6 / tone.hz);
    EXPECT_FALSE(high);
    const std::size_t count = turns.size();
    rig.machine.advance(ms(100));
    EXPECT_EQ(turns.size(), count) << "silence";
  }
}

TEST_P(BuzzerDriver, ANewToneEndsTheOldOneAndZeroIsSilence) {
  buzzer.sound(500, 1000);
  rig.machine.advance(ms(11));
  turns.clear();
  buzzer.sound(1000, 50);
  rig.machine.advance(ms(200));
  EXPECT_LE(turns.size(), 102u);
  buzzer.sound(500, 1000);
  rig.machine.advance(ms(11));
  buzzer.sound(500, 0);
  turns.clear();
  rig.machine.advance(ms(100));
  EXPECT_EQ(turns.size(), 0u);
  EXPECT_FALSE(high);
}

TEST_P(BuzzerDriver, WithoutAPinOrWithAnImpossibleToneNothingHappens) {
  Buzzer<Io> none({}, rig.machine.io());
  none.open(rig.clocks.apb1_timer_hz);
  none.sound(1000, 100);
  for (const std::uint32_t hz : {0u, 19u, 20'001u}) buzzer.sound(hz, 100);
  rig.machine.advance(ms(50));
  EXPECT_EQ(turns.size(), 0u);
}

}  // namespace
}  // namespace verp::hal::stm32::test
