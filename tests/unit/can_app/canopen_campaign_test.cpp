#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/can_app/can_loop.hpp"

namespace verp::app {
namespace {

using canopen::cia402::State;
using test::kAll;
using test::kBenchJoints;
using Loop = test::CanLoop;

struct Campaign {
  Loop& loop = test::new_can_loop();
  std::uint32_t lost_power = 0;  ///< drives without power since the robot relaxed

  explicit Campaign(std::uint32_t seed) {
    loop.bench.seed = seed;
    loop.enable();
  }
  test::DriveNode& any_drive(std::uint32_t& bit) {
    const std::uint32_t j = loop.bench.random(kBenchJoints);
    bit = 1u << j;
    return loop.bench.drives[j];
  }
  void happen() {
    std::uint32_t bit = 0;
    switch (loop.bench.random(60)) {
      case 0:
        any_drive(bit).reboot();
        lost_power |= bit;
        break;
      case 1:
        any_drive(bit).fail(canopen::ErrorCode::kOverCurrent, false);
        lost_power |= bit;
        break;
      case 2:
        any_drive(bit).off ^= true;
        break;
      case 3:
        loop.bench.imu.reboot();
        break;
      case 4:
        loop.bench.down = !loop.bench.down;
        break;
      case 5:
        loop.bench.babble = !loop.bench.babble;
        break;
      case 6:
        loop.bench.left.reboot();
        break;
      default:
        break;
    }
  }
  void calm() {
    loop.bench.trouble = 0;
    loop.bench.down = false;
    loop.bench.babble = false;
    for (test::DriveNode& drive : loop.bench.drives) drive.off = false;
  }
};

TEST(CanopenCampaign, NoSeedThrowsADriveAtItsGoalOrLeavesOneOut) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    Campaign campaign(seed);
    Loop& loop = campaign.loop;
    loop.bench.trouble = loop.bench.random(30);
    const std::uint64_t begun_us = loop.bench.now_us();
    for (unsigned i = 0; i < 300; ++i) {
      const std::uint64_t before_us = loop.bench.now_us();
      loop.tick();
      // A tick without waiting ends before its SYNC, so the next one contains both waits. The time
      // counts from the SYNC, over all ticks.
      const std::uint64_t period_us = loop.bench.params.period_us;
      EXPECT_LE(loop.bench.now_us() - std::max(before_us, loop.bench.tick_us), period_us) << seed;
      EXPECT_LE(loop.bench.now_us() - begun_us, (i + 2) * period_us) << seed;
      for (int j = 0; j < kBenchJoints; ++j) {
        const bool lost = (campaign.lost_power >> j & 1) != 0;
        EXPECT_FALSE(lost && loop.bench.drives[j].application.drive.powered())
            << "seed " << seed << " tick " << i << " joint " << j;
      }
      campaign.happen();
    }
    campaign.calm();
    loop.outputs.torque_enable = 0;
    loop.run(200);
    for (int i = 0; i < 10; ++i) {
      loop.tick();
      EXPECT_EQ(loop.inputs.fresh, kAll) << "seed " << seed;
      EXPECT_EQ(loop.inputs.flags & (kImuFresh | kFeetFresh), kImuFresh | kFeetFresh) << seed;
    }
    loop.outputs.torque_enable = kAll;
    loop.run(12);
    EXPECT_TRUE(loop.all_in(State::kOperationEnabled)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace verp::app
