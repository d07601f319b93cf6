#include <gtest/gtest.h>

#include "hal/chip/stm32/registers/flash.hpp"
#include "tests/host/stm32_model/chip.hpp"
#include "tests/support/stm32/flash_model.hpp"

namespace verp::hal::stm32::model {
namespace {

using namespace flash;

constexpr std::uint32_t kF = base::kFlash;

void unlock(ModelIo& io) {
  io.write32(kF + kKeyr, kKey1);
  io.write32(kF + kKeyr, kKey2);
}

bool program(Machine& machine, std::uint32_t address, std::uint32_t value) {
  ModelIo io = machine.io();
  io.write32(kF + kCr, kCrPg | kPsize32 << kCrPsizeShift);
  io.write32(address, value);
  const bool done = wait_clear(machine, kF + kSr, kSrBsy, ms(1));
  if (done) io.write32(kF + kCr, 0);
  return done;
}

bool erase(Machine& machine, std::uint32_t sector) {
  ModelIo io = machine.io();
  const std::uint32_t cr = kCrSer | sector << kCrSnbShift | kPsize32 << kCrPsizeShift;
  io.write32(kF + kCr, cr);
  io.write32(kF + kCr, cr | kCrStrt);
  const bool done = wait_clear(machine, kF + kSr, kSrBsy, 5 * kSecond);
  if (done) io.write32(kF + kCr, 0);
  return done;
}

TEST(Flash, ProgramsClearsBitsAndErasesWholeSectors) {
  for (const Family family : kFamilies) {
    Machine machine(family, {.access_cycles = 1000});
    ModelIo io = machine.io();
    const Sector& sector = limits(family).sectors[2];
    unlock(io);
    EXPECT_TRUE(program(machine, sector.address, 0x12345678));
    EXPECT_EQ(io.read32(sector.address), 0x12345678u);
    EXPECT_TRUE(program(machine, sector.address, 0xFFFF0000));
    EXPECT_EQ(io.read32(sector.address), 0x12340000u);
    EXPECT_TRUE(program(machine, sector.address - 4, 1));
    EXPECT_TRUE(erase(machine, 2));
    EXPECT_EQ(io.read32(sector.address), 0xFFFFFFFFu);
    EXPECT_EQ(io.read32(sector.address - 4), 1u);
    EXPECT_EQ(machine.violations_text(), "");
  }
}

TEST(Flash, OpensOnlyWithItsKeysAndAWrongOneLocksItUntilReset) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  io.write32(kF + kCr, kCrPg);
  EXPECT_TRUE(one_violation(machine, "locked"));
  io.write32(kF + kKeyr, kKey2);
  EXPECT_TRUE(one_violation(machine, "wrong key"));
  unlock(io);
  EXPECT_FALSE(machine.violations().empty());
  EXPECT_NE(io.read32(kF + kCr) & kCrLock, 0u);
  machine.reset(ResetCause::kSoftware);
  machine.forget_violations();
  unlock(io);
  EXPECT_EQ(io.read32(kF + kCr) & kCrLock, 0u);
  modify32(io, kF + kCr, 0, kCrLock);
  EXPECT_NE(io.read32(kF + kCr) & kCrLock, 0u);
  EXPECT_EQ(machine.violations_text(), "");
}

TEST(Flash, WrongWidthAlignmentModeAndProtectionAreErrors) {
  Machine machine(Family::kF405);
  ModelIo io = machine.io();
  unlock(io);
  const auto flags = [&] { return io.read32(kF + kSr) & kSrErrors; };
  const auto clear = [&] {
    io.write32(kF + kSr, kSrErrors);
    machine.forget_violations();
  };
  io.write32(kFlashBase + 0x4000, 1);
  EXPECT_EQ(flags(), kSrPgserr);
  clear();
  io.write32(kF + kCr, kCrPg | kPsize32 << kCrPsizeShift);
  io.write8(kFlashBase + 0x4000, 1);
  EXPECT_EQ(flags(), kSrPgperr);
  clear();
  io.write32(kFlashBase + 0x4002, 1);
  EXPECT_EQ(flags(), kSrPgaerr);
  clear();
  machine.flash().protected_sectors = 2;
  io.write32(kFlashBase + 0x4000, 1);
  EXPECT_EQ(flags(), kSrWrperr);
  EXPECT_EQ(machine.violations_text(), "");
  EXPECT_EQ(machine.flash().byte(kFlashBase + 0x4000), 0xFF);
}

TEST(Flash, AStuckBusyBitNeverFalls) {
  Machine machine(Family::kF746);
  ModelIo io = machine.io();
  machine.flash().busy_stuck = true;
  unlock(io);
  EXPECT_FALSE(program(machine, kFlashBase + 0x8000, 1));
  io.write32(kF + kCr, 0);
  EXPECT_TRUE(one_violation(machine, "while BSY"));
}

TEST(Flash, ErasingTakesTimeByTheSectorsSize) {
  Machine machine(Family::kF405, {.access_cycles = 1000});
  ModelIo io = machine.io();
  unlock(io);
  const Time before = machine.now();
  EXPECT_TRUE(erase(machine, 0));
  const Time small = machine.now() - before;
  EXPECT_TRUE(erase(machine, 5));
  EXPECT_NEAR(static_cast<double>(machine.now() - before - small) / static_cast<double>(small), 8,
              0.1);
}

TEST(Flash, APowerCutLeavesOnlyTheBitsUnsureThatWereToChange) {
  unsigned mixed = 0;
  for (std::uint32_t i = 0; i < 64; ++i) {
    Machine machine(Family::kF405);
    ModelIo io = machine.io();
    machine.flash().seed(i);
    unlock(io);
    ASSERT_TRUE(program(machine, kFlashBase + 0x4000, 0x0000FFFF));
    machine.flash().cut_power_after(1);
    ASSERT_TRUE(program(machine, kFlashBase + 0x4008, 7));
    program(machine, kFlashBase + 0x4004, 0xFF00FF00);
    EXPECT_TRUE(machine.dark());
    EXPECT_EQ(io.read32(kFlashBase + 0x4000), 0u);
    machine.power_on();
    EXPECT_EQ(io.read32(kFlashBase + 0x4000), 0x0000FFFFu);
    EXPECT_EQ(io.read32(kFlashBase + 0x4008), 7u);
    const std::uint32_t torn = io.read32(kFlashBase + 0x4004);
    EXPECT_EQ(torn | 0x00FF00FFu, 0xFFFFFFFFu);
    mixed += torn != 0xFFFFFFFFu && torn != 0xFF00FF00u ? 1u : 0u;
    EXPECT_NE(io.read32(base::kRcc + rcc::kCsr) & rcc::kCsrPorrstf, 0u);
  }
  EXPECT_GT(mixed, 4u);
}

}  // namespace
}  // namespace verp::hal::stm32::model
