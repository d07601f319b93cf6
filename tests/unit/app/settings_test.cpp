#include "firmware/app/settings.hpp"

#include <gtest/gtest.h>

#include "firmware/store/flash_store.hpp"
#include "hal/fake/fake_flash.hpp"

namespace verp {
namespace {

using app::OperatorSetup;
using app::Settings;
using app::table::ImuSource;
using Flash = hal::FakeFlash<512, 4>;
using Memory = store::FlashStore<Flash, 4, 64>;

OperatorSetup with_both_sources() {
  OperatorSetup setup;
  setup.imu_sources = 3;
  return setup;
}

struct Life {
  explicit Life(Flash& flash, const OperatorSetup& defaults = with_both_sources())
      : memory(flash), keeper(memory), setup(defaults) {
    memory.open();
    keeper.load(setup);
  }
  void keep(const Settings& settings) {
    for (int i = 0; i < 100 && keeper.keep(settings, true); ++i) {
    }
  }
  Memory memory;
  app::SettingsKeeper<Memory> keeper;
  OperatorSetup setup;
};

TEST(Settings, AreTheDefaultsUntilTheOperatorChangesThem) {
  Flash flash;
  Life life(flash);
  EXPECT_EQ(life.setup.id, app::table::kDefaultId);
  EXPECT_TRUE(life.setup.imu_source == ImuSource::kBus);
  EXPECT_EQ(life.setup.torque_limit_percent, 100);
  life.keep({life.setup.id, life.setup.imu_source});
  EXPECT_EQ(flash.programs(), 0u);
}

TEST(Settings, OutliveTheNextStarts) {
  Flash flash;
  Life(flash).keep({17, ImuSource::kChip});
  for (int start = 0; start < 3; ++start) {
    Life life(flash);
    EXPECT_EQ(life.setup.id, 17);
    EXPECT_TRUE(life.setup.imu_source == ImuSource::kChip);
  }
  Life(flash).keep({18, ImuSource::kBus});
  Life last(flash);
  EXPECT_EQ(last.setup.id, 18);
  EXPECT_TRUE(last.setup.imu_source == ImuSource::kBus);
}

// A reset in the first steps must not release full strength.
TEST(Settings, HoldTheTorqueLimitOverAnyStartUntilTheOperatorLiftsIt) {
  Flash flash;
  Life(flash).keep({17, ImuSource::kBus, 30});
  for (int start = 0; start < 3; ++start) EXPECT_EQ(Life(flash).setup.torque_limit_percent, 30);
  Life(flash).keep({17, ImuSource::kBus, 100});
  EXPECT_EQ(Life(flash).setup.torque_limit_percent, 100);
}

// Firmware before the torque limit kept these.
TEST(Settings, OfTheVersionWithoutATorqueLimitStillHold) {
  Flash flash;
  Memory memory(flash);
  memory.open();
  const std::uint8_t once[3] = {1, 17, 0};
  memory.put(app::kSettingsKey, once, sizeof once);
  while (memory.work(true) == hal::WorkState::kWorking) {
  }
  Life life(flash);
  EXPECT_EQ(life.setup.id, 17);
  EXPECT_TRUE(life.setup.imu_source == ImuSource::kChip);
  EXPECT_EQ(life.setup.torque_limit_percent, 100);
  life.keep({17, ImuSource::kChip, 40});
  EXPECT_EQ(Life(flash).setup.torque_limit_percent, 40);
}

// Flash wears.
TEST(Settings, AreWrittenOnceForEachChange) {
  Flash flash;
  Life life(flash);
  life.keep({17, ImuSource::kBus});
  const std::uint32_t programs = flash.programs();
  for (int i = 0; i < 50; ++i) life.keep({17, ImuSource::kBus});
  EXPECT_EQ(flash.programs(), programs);
}

TEST(Settings, OfAnotherBoardAreNotObeyed) {
  Flash flash;
  Life(flash).keep({17, ImuSource::kChip});
  Life without_chip(flash, OperatorSetup{});
  EXPECT_EQ(without_chip.setup.id, 17);
  EXPECT_TRUE(without_chip.setup.imu_source == ImuSource::kBus);
}

// An emulator has no flash; the loop must not retry for ever.
TEST(Settings, GiveUpOnAMemoryThatRefuses) {
  Flash flash;
  flash.refuse(1000000);
  Life life(flash);
  int steps = 0;
  while (life.keeper.keep({17, ImuSource::kBus}, true) && steps < 1000) ++steps;
  EXPECT_LT(steps, 1000);
}

TEST(Settings, ThatNoVersionOfOursWroteAreIgnored) {
  Flash flash;
  Memory memory(flash);
  memory.open();
  const std::uint8_t strange[3] = {99, 17, 0};
  memory.put(app::kSettingsKey, strange, sizeof strange);
  while (memory.work(true) == hal::WorkState::kWorking) {
  }
  EXPECT_EQ(Life(flash).setup.id, app::table::kDefaultId);
  const std::uint8_t out_of_range[3] = {1, 253, 7};
  memory.put(app::kSettingsKey, out_of_range, sizeof out_of_range);
  while (memory.work(true) == hal::WorkState::kWorking) {
  }
  const Life life(flash);
  EXPECT_EQ(life.setup.id, app::table::kDefaultId);
  EXPECT_TRUE(life.setup.imu_source == ImuSource::kBus);
  for (const std::uint8_t limit : {std::uint8_t{0}, std::uint8_t{101}, std::uint8_t{255}}) {
    const std::uint8_t bytes[4] = {1, 17, 1, limit};
    memory.put(app::kSettingsKey, bytes, sizeof bytes);
    while (memory.work(true) == hal::WorkState::kWorking) {
    }
    EXPECT_EQ(Life(flash).setup.torque_limit_percent, 100) << int{limit};
  }
}

}  // namespace
}  // namespace verp
