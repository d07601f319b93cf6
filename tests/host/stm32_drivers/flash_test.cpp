#include "hal/chip/stm32/flash_pages.hpp"

#include "firmware/store/flash_store.hpp"
#include "hal/chip/stm32/brown_out.hpp"
#include "hal/chip/stm32/watchdog.hpp"
#include "tests/host/stm32_drivers/rig.hpp"
#include "tests/support/stm32/flash_model.hpp"
#include "tests/support/stm32/iwdg_model.hpp"

// hal/contract/flash_pages.hpp.
namespace verp::hal::stm32::test {
namespace {

/// An Io whose registers read as zero.
struct NoChip {
  std::uint8_t read8(std::uint32_t) { return 0; }
  std::uint16_t read16(std::uint32_t) { return 0; }
  std::uint32_t read32(std::uint32_t) { return 0; }
  void write8(std::uint32_t, std::uint8_t) {}
  void write16(std::uint32_t, std::uint16_t) {}
  void write32(std::uint32_t, std::uint32_t) {}
  std::uint32_t bus_address(const void*, std::size_t) { return 0; }
  void barrier() {}
  bool mask_interrupts() { return false; }
  void unmask_interrupts() {}
  void wait_for_interrupt() {}
};

using Dog = IndependentWatchdog<Io>;
using Pages = SectorPages<Io, Timer, Dog>;
static_assert(FlashPages<Pages>);

class FlashDriver : public EachFamily {
 protected:
  FlashDriver() {
    for (std::uint32_t i = 0; i < 8; ++i) memory(i) = 0;
  }
  std::uint8_t& memory(std::uint32_t offset) {
    return rig.machine.flash().byte(limits(GetParam()).sectors[1].address + offset);
  }
  Rig rig{GetParam()};
  Dog dog{ResetCause::kPowerOn, rig.machine.io()};
  Pages pages{GetParam(), 1, 2, rig.timer, dog, rig.machine.io()};
};
INSTANTIATE_TEST_SUITE_P(, FlashDriver, kFamilies, name_of);

TEST_P(FlashDriver, EraseSetsAllBitsOfItsSectorOnly) {
  rig.machine.flash().byte(limits(GetParam()).sectors[2].address) = 0x12;
  ASSERT_TRUE(pages.erase(0));
  std::uint8_t bytes[8];
  pages.read(0, 0, bytes, sizeof bytes);
  for (const std::uint8_t byte : bytes) EXPECT_EQ(byte, 0xFF);
  pages.read(1, 0, bytes, 1);
  EXPECT_EQ(bytes[0], 0x12);
}

TEST_P(FlashDriver, ProgrammingOnlyClearsBits) {
  ASSERT_TRUE(pages.erase(0));
  const std::uint8_t first[4] = {0xF0, 0x0F, 0xAA, 0xFF};
  const std::uint8_t second[4] = {0xCC, 0xCC, 0xCC, 0xCC};
  EXPECT_TRUE(pages.program(0, 8, first));
  EXPECT_TRUE(pages.program(0, 8, second));
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(memory(8 + i), first[i] & second[i]);
}

TEST_P(FlashDriver, ReportsWhatTheMemoryReports) {
  ASSERT_TRUE(pages.erase(0));
  const std::uint8_t word[4] = {1, 2, 3, 4};
  rig.machine.flash().fail_next = 1;
  EXPECT_FALSE(pages.program(0, 0, word));
  rig.machine.flash().fail_next = 1;
  EXPECT_FALSE(pages.erase(0));
  EXPECT_TRUE(pages.erase(0)) << "the error of before is forgotten";
  rig.machine.flash().protected_sectors = 1u << 1;
  EXPECT_FALSE(pages.program(0, 0, word));
  EXPECT_FALSE(pages.erase(0));
}

TEST_P(FlashDriver, ABusyFlagThatSticksIsAnErrorAndNotAWait) {
  const std::uint8_t word[4] = {};
  rig.machine.flash().busy_stuck = true;
  EXPECT_FALSE(pages.program(0, 0, word));
  EXPECT_FALSE(pages.program(0, 4, word));
  EXPECT_FALSE(pages.erase(0));
}

TEST_P(FlashDriver, RefusesWhatIsNoUnitOfAPage) {
  const std::uint8_t word[4] = {};
  EXPECT_FALSE(pages.program(0, 2, word));
  EXPECT_FALSE(pages.program(2, 0, word));
  EXPECT_FALSE(pages.program(0, pages.page_bytes(0), word));
  EXPECT_FALSE(pages.erase(2));
}

TEST_P(FlashDriver, WatchdogSleepsThroughAnEraseAndWakesAfterIt) {
  rig.machine.flash().erase_time_per_kb = ms(30);
  rig.machine.iwdg().lsi_hz = 47'000;
  ASSERT_TRUE(dog.start(20'000));
  EXPECT_TRUE(pages.erase(0));
  EXPECT_EQ(rig.machine.resets(), 0u);
  rig.machine.advance(ms(70));
  EXPECT_EQ(rig.machine.resets(), 1u) << "it guards again";
}

TEST_P(FlashDriver, BrownOutLevelIsWrittenOnceAndKeepsTheOtherOptions) {
  Io io = rig.machine.io();
  const std::uint32_t before = io.read32(base::kFlash + flash::kOptcr);
  ASSERT_EQ(before & flash::kOptcrBorLev, flash::kOptcrBorLev) << "delivered without one";
  EXPECT_EQ(keep_brown_out(io), BrownOut::kWritten);
  const std::uint32_t after = io.read32(base::kFlash + flash::kOptcr);
  EXPECT_EQ(after, before & ~flash::kOptcrBorLev) << "locked again, all else as it was";
  rig.machine.reset(model::ResetCause::kPin);
  const auto begun = rig.machine.now();
  EXPECT_EQ(keep_brown_out(io), BrownOut::kKept);
  EXPECT_LT(rig.machine.now() - begun, ms(1)) << "no second write";
}

TEST_P(FlashDriver, BrownOutLevelOfABusyFlashIsLeftForTheNextStart) {
  Io io = rig.machine.io();
  rig.machine.flash().busy_stuck = true;
  io.write32(base::kFlash + flash::kKeyr, flash::kKey1);
  io.write32(base::kFlash + flash::kKeyr, flash::kKey2);
  pages.erase(0);
  EXPECT_EQ(keep_brown_out(io), BrownOut::kRefused);
  EXPECT_EQ(io.read32(base::kFlash + flash::kOptcr) & flash::kOptcrBorLev, flash::kOptcrBorLev);
}

TEST_P(FlashDriver, BrownOutLevelThatTheChipRefusesIsNamed) {
  Io io = rig.machine.io();
  for (const auto refusal :
       {model::FlashModel::Options::kFrozen, model::FlashModel::Options::kFail}) {
    rig.machine.flash().options = refusal;
    rig.machine.reset(model::ResetCause::kPin);
    EXPECT_EQ(keep_brown_out(io), BrownOut::kRefused) << static_cast<int>(refusal);
  }
  // Each start claims to have written it.
  rig.machine.flash().options = model::FlashModel::Options::kForget;
  for (int start = 0; start < 2; ++start) {
    rig.machine.reset(model::ResetCause::kPin);
    EXPECT_EQ(keep_brown_out(io), BrownOut::kWritten);
  }
  rig.machine.flash().options = model::FlashModel::Options::kTake;
  rig.machine.reset(model::ResetCause::kPin);
  EXPECT_EQ(keep_brown_out(io), BrownOut::kWritten) << "the next start tries again";
  rig.machine.reset(model::ResetCause::kPin);
  EXPECT_EQ(keep_brown_out(io), BrownOut::kKept);
}

TEST(BrownOutLevel, OfAnEmulatorWithoutFlashControllerIsUnknown) {
  EXPECT_EQ(keep_brown_out(NoChip{}), BrownOut::kUnknown);
}

TEST_P(FlashDriver, CarriesTheStore) {
  store::FlashStore<Pages> store(pages);
  store.open();
  for (std::uint8_t round = 0; round < 20; ++round) {
    const std::uint8_t value[5] = {round, 1, 2, 3, 4};
    ASSERT_EQ(store.put(7, value, sizeof value), PutResult::kAccepted);
    WorkState state = WorkState::kWorking;
    for (int i = 0; i < 50 && state == WorkState::kWorking; ++i) state = store.work(true);
    ASSERT_EQ(state, WorkState::kIdle);
  }
  store::FlashStore<Pages> after_reset(pages);
  after_reset.open();
  std::uint8_t value[5] = {};
  EXPECT_EQ(after_reset.get(7, value, sizeof value), 5u);
  EXPECT_EQ(value[0], 19);
}

}  // namespace
}  // namespace verp::hal::stm32::test
