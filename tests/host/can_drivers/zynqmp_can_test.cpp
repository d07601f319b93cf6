#include "hal/chip/zynqmp_can/zynqmp_can.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/can/zynqmp_can_model.hpp"

namespace verp::hal::zynqmp_can {
namespace {

constexpr std::uint32_t kPlenty_us = 20'000;
constexpr std::uint32_t kBitRate_hz = 1'000'000;
using Model = test::ZynqmpCanModel<Layout::kSilicon>;
using Io = test::ZynqmpCanModelIo<Layout::kSilicon>;
using Driver = ZynqmpCan<Io>;
constexpr CanTiming kTiming = Driver::timing(100'000'000, kBitRate_hz);

CanFrame numbered(std::uint32_t id, unsigned number, std::uint8_t size = 8) {
  CanFrame frame;
  frame.id = id;
  frame.size = size;
  for (unsigned i = 0; i < size; ++i) frame.data[i] = static_cast<std::uint8_t>(number + i);
  return frame;
}

struct Rig {
  Rig() { EXPECT_TRUE(driver.open(kTiming, kBitRate_hz)); }
  ~Rig() { EXPECT_EQ(model.violations(), 0u) << model.first_violation(); }
  void settle() {
    CanFrame frame;
    EXPECT_FALSE(driver.poll(frame, kPlenty_us));
  }
  std::vector<std::uint32_t> heard_ids() {
    std::vector<std::uint32_t> ids;
    for (CanFrame frame; model.wire.far_take(frame);) ids.push_back(frame.id);
    return ids;
  }
  Model model;
  Driver driver{Io(model)};
};
using Ids = std::vector<std::uint32_t>;

// 100 MHz: 5 times 20 quanta, 1 + 15 before the sample, 4 behind (UG1087, BRPR and BTR).
TEST(ZynqmpCanDriver, OpensWithTheTimingOfItsClock) {
  Rig rig;
  EXPECT_TRUE(rig.model.joined());
  EXPECT_EQ(rig.model.brpr(), 4u);
  EXPECT_EQ(rig.model.btr(), 2u << 7 | 2u << 4 | 15u) << "sampled at 85 %";
}

TEST(ZynqmpCanDriver, RefusesARateThatItsClockCannotGive) {
  Model model;
  Driver driver{Io(model)};
  EXPECT_FALSE(driver.open(Driver::timing(33'333'333, kBitRate_hz), kBitRate_hz));
  EXPECT_FALSE(driver.send(numbered(1, 1)));
}

struct NoChip {
  std::uint32_t read32(std::uint32_t) { return 0; }
  void write32(std::uint32_t, std::uint32_t) {}
  std::uint64_t now_us() { return 0; }
  void doze_until(std::uint64_t) {}
};

TEST(ZynqmpCanDriver, KnowsThatThereIsNoController) {
  EXPECT_FALSE(ZynqmpCan<NoChip>(NoChip{}).open(kTiming, kBitRate_hz));
}

TEST(ZynqmpCanDriver, SendsTheMostUrgentOfThoseThatWait) {
  Rig rig;
  ASSERT_TRUE(rig.driver.send(numbered(0x600, 1)));
  rig.settle();  // must not count for the next frame
  rig.model.wire.hold(true);
  for (const std::uint32_t id : {0x500u, 0x400u, 0x100u, 0x300u}) {
    ASSERT_TRUE(rig.driver.send(numbered(id, id)));
  }
  rig.model.wire.hold(false);
  rig.settle();
  EXPECT_EQ(rig.heard_ids(), (Ids{0x600, 0x500, 0x100, 0x300, 0x400}))
      << "the first was in the chip";
}

TEST(ZynqmpCanDriver, CountsFramesThatFindTheFifoFull) {
  Rig rig;
  for (unsigned i = 0; i < kFifoFrames + 6; ++i) rig.model.wire.far_send(numbered(0x181, i));
  rig.model.advance(10'000);
  unsigned brought = 0;
  for (CanFrame frame; rig.driver.poll(frame, kPlenty_us); ++brought) {
    EXPECT_EQ(frame.data[0], brought);
  }
  EXPECT_EQ(brought, kFifoFrames);
  EXPECT_GE(rig.driver.errors().overruns, 1u);
}

TEST(ZynqmpCanDriver, CountsErrorFramesAndSendsAgain) {
  Rig rig;
  rig.model.wire.spoil(3);
  ASSERT_TRUE(rig.driver.send(numbered(0x123, 1)));
  rig.settle();
  EXPECT_EQ(rig.driver.errors().errors, 3u);
  EXPECT_EQ(rig.heard_ids(), Ids{0x123});
}

// ISO 11898-1: 128 times 11 recessive bits.
TEST(ZynqmpCanDriver, StaysAwayFromTheBusAsLongAsTheStandardAsks) {
  Rig rig;
  ASSERT_TRUE(rig.driver.send(numbered(0x123, 1)));
  rig.model.wire.spoil(1000);
  for (std::uint32_t us = 0; us < kPlenty_us && !rig.model.off(); ++us) rig.model.advance(1);
  CanFrame frame;
  rig.driver.poll(frame, 0);
  rig.model.wire.spoil(0);
  const std::uint64_t off_us = rig.model.wire.now_us();
  while (!rig.model.joined()) {
    rig.driver.poll(frame, 0);
    ASSERT_LT(rig.model.wire.now_us(), off_us + 2 * kPlenty_us);
  }
  EXPECT_GE(rig.model.wire.now_us() - off_us, 128u * 11 - 20) << "less what the last accesses took";
}

}  // namespace
}  // namespace verp::hal::zynqmp_can
