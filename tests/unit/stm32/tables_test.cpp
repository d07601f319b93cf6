#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "tests/support/stm32/registers/adc_table.hpp"
#include "tests/support/stm32/registers/can_table.hpp"
#include "tests/support/stm32/registers/dma_table.hpp"
#include "tests/support/stm32/registers/flash_table.hpp"
#include "tests/support/stm32/registers/gpio_table.hpp"
#include "tests/support/stm32/registers/iwdg_table.hpp"
#include "tests/support/stm32/registers/otg_fs_table.hpp"
#include "tests/support/stm32/registers/pwr_table.hpp"
#include "tests/support/stm32/registers/rcc_table.hpp"
#include "tests/support/stm32/registers/spi_table.hpp"
#include "tests/support/stm32/registers/syscfg_table.hpp"
#include "tests/support/stm32/registers/timer_table.hpp"
#include "tests/support/stm32/registers/usart_table.hpp"

namespace verp::hal::stm32 {
namespace {

const Table kTables[] = {
    adc::kTable,
    adc::kCommonTable,
    can::kTable,
    can::kTransmitTable,
    can::kReceiveTable,
    can::kFilterTable,
    can::kBankTable,
    dma::kTable,
    dma::kStreamTable,
    exti::kTable,
    exti::kTableF7,
    flash::kTableF405,
    flash::kTableF446,
    flash::kTableF746,
    gpio::kTable,
    iwdg::kTable,
    iwdg::kTableF7,
    otg_fs::kTableF405,
    otg_fs::kTableF7,
    otg_fs::kFifoTable,
    otg_fs::kDeviceTableF405,
    otg_fs::kDeviceTableF7,
    otg_fs::kIn0TableF405,
    otg_fs::kIn0TableF7,
    otg_fs::kInTableF405,
    otg_fs::kInTableF7,
    otg_fs::kOut0TableF405,
    otg_fs::kOut0TableF7,
    otg_fs::kOutTableF405,
    otg_fs::kOutTableF7,
    otg_fs::kPowerTable,
    pwr::kTableF405,
    pwr::kTableF446,
    pwr::kTableF746,
    rcc::kTableF405,
    rcc::kTableF446,
    rcc::kTableF746,
    spi::kTableF405,
    spi::kTableF446,
    spi::kTableF746,
    syscfg::kTableF405,
    syscfg::kTableF446,
    syscfg::kTableF746,
    timer::kTable,
    timer::kTableF7,
    usart_v1::kTable,
    usart_v2::kTable,
};

// A braced list would need a header.
constexpr Family kFamilies[] = {Family::kF405, Family::kF446, Family::kF746};

TEST(Tables, RegistersAreWordsInOrderWithoutOverlap) {
  for (const Table& table : kTables) {
    std::uint32_t next_offset = 0;
    std::uint32_t last_paragraph = 0;
    bool first = true;
    for (const Register& reg : table) {
      EXPECT_EQ(reg.offset % 4, 0u) << table.name << " " << reg.name;
      EXPECT_LT(reg.offset, 0x400u) << table.name << " " << reg.name;
      EXPECT_TRUE(first || reg.offset >= next_offset) << table.name << " " << reg.name;
      EXPECT_GE(reg.paragraph, last_paragraph == 0 ? 1u : last_paragraph)
          << table.name << " " << reg.name;
      EXPECT_NE(reg.defined(), 0u) << table.name << " " << reg.name;
      next_offset = reg.offset + 4;
      last_paragraph = reg.paragraph;
      first = false;
    }
  }
}

TEST(Tables, ABitHasOneAccessTypeAndWriteOnlyBitsResetToZero) {
  for (const Table& table : kTables) {
    for (const Register& reg : table) {
      const std::uint32_t masks[] = {reg.rw, reg.r, reg.w, reg.rs, reg.rc_w0, reg.rc_w1, reg.rc_r};
      std::uint32_t seen = 0;
      for (const std::uint32_t mask : masks) {
        EXPECT_EQ(seen & mask, 0u) << table.name << " " << reg.name;
        seen |= mask;
      }
      EXPECT_EQ(reg.reset & reg.w, 0u) << table.name << " " << reg.name;
    }
  }
}

TEST(Tables, EveryTableNamesItsManual) {
  for (const Table& table : kTables) {
    std::size_t manuals = 0;
    for (const char* c = table.manuals; *c != '\0'; ++c) manuals += *c == 'R' ? 1u : 0u;
    EXPECT_GE(manuals, 1u) << table.name;
    EXPECT_LE(manuals, 3u) << table.name;
  }
}

TEST(Tables, DmaFlagsOfDifferentStreamsDoNotOverlap) {
  for (std::uint32_t a = 0; a < dma::kStreams; ++a) {
    for (std::uint32_t b = a + 1; b < dma::kStreams; ++b) {
      if (dma::status_offset(a) != dma::status_offset(b)) continue;
      EXPECT_EQ((dma::kFlagAll << dma::flag_shift(a)) & (dma::kFlagAll << dma::flag_shift(b)), 0u);
    }
  }
}

TEST(Tables, InterruptsOfDmaStreamsAreApart) {
  for (unsigned a = 0; a < dma::kStreams; ++a) {
    for (unsigned b = 0; b < dma::kStreams; ++b) {
      EXPECT_NE(irq::dma1(a), irq::dma2(b));
      EXPECT_TRUE(a == b || irq::dma1(a) != irq::dma1(b));
      EXPECT_TRUE(a == b || irq::dma2(a) != irq::dma2(b));
    }
  }
}

TEST(Tables, FlashSectorsFillTheMemoryWithoutGap) {
  for (const Family family : kFamilies) {
    const Limits& chip = limits(family);
    std::uint32_t next = kFlashBase;
    for (std::uint32_t i = 0; i < chip.sector_count; ++i) {
      EXPECT_EQ(chip.sectors[i].address, next);
      next += chip.sectors[i].bytes;
    }
    EXPECT_EQ(next, kFlashBase + chip.flash_bytes);
  }
}

TEST(Tables, TheHighestClockHasEnoughWaitStates) {
  for (const Family family : kFamilies) {
    const Limits& chip = limits(family);
    EXPECT_LE(chip.sysclk_overdrive_max_hz, chip.hz_per_wait_state * (chip.wait_states_max + 1));
    EXPECT_LE(chip.sysclk_max_hz, chip.sysclk_overdrive_max_hz);
  }
}

}  // namespace
}  // namespace verp::hal::stm32
