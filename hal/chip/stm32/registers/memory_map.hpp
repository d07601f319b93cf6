#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Base addresses: RM0090 2.3, RM0390 2.2.2, RM0385 2.2.2, the same in all three unless named
/// otherwise. Interrupts: RM0090 12.2, RM0390 10.2, RM0385 10.1.
namespace verp::hal::stm32 {

namespace base {
inline constexpr std::uint32_t kTim2 = 0x40000000, kTim3 = 0x40000400, kTim4 = 0x40000800,
                               kTim5 = 0x40000C00, kIwdg = 0x40003000, kSpi2 = 0x40003800,
                               kSpi3 = 0x40003C00, kUsart2 = 0x40004400, kUsart3 = 0x40004800,
                               kUart4 = 0x40004C00, kUart5 = 0x40005000, kI2c1 = 0x40005400,
                               kI2c2 = 0x40005800, kI2c3 = 0x40005C00, kCan1 = 0x40006400,
                               kCan2 = 0x40006800, kPwr = 0x40007000, kUart7F746 = 0x40007800,
                               kUart8F746 = 0x40007C00;
inline constexpr std::uint32_t kTim1 = 0x40010000, kUsart1 = 0x40011000, kUsart6 = 0x40011400,
                               kAdc1 = 0x40012000, kAdc2 = 0x40012100, kAdc3 = 0x40012200,
                               kAdcCommon = 0x40012300, kSpi1 = 0x40013000, kSyscfg = 0x40013800;
inline constexpr std::uint32_t kGpioA = 0x40020000, kGpioStep = 0x400, kRcc = 0x40023800,
                               kFlash = 0x40023C00, kDma1 = 0x40026000, kDma2 = 0x40026400,
                               kOtgFs = 0x50000000;
constexpr std::uint32_t gpio(char port) {
  return kGpioA + kGpioStep * static_cast<std::uint32_t>(port - 'A');
}
}  // namespace base

namespace irq {
inline constexpr unsigned kFlash = 4, kRcc = 5, kAdc = 18, kCan1Tx = 19, kCan1Error = 22,
                          kTim2 = 28, kTim3 = 29, kTim4 = 30, kSpi1 = 35, kSpi2 = 36, kUsart1 = 37,
                          kUsart2 = 38, kUsart3 = 39, kTim5 = 50, kSpi3 = 51, kUart4 = 52,
                          kUart5 = 53, kCan2Tx = 63, kOtgFs = 67, kUsart6 = 71, kUart7F746 = 82,
                          kUart8F746 = 83;
constexpr unsigned dma1(unsigned stream) {
  return stream < 7 ? 11 + stream : 47;
}
constexpr unsigned dma2(unsigned stream) {
  return stream < 5 ? 56 + stream : 63 + stream;
}
}  // namespace irq

struct Sector {
  std::uint32_t address;
  std::uint32_t bytes;
};

/// Clocks at 2.7 to 3.6 V. Defaults hold for all families.
struct Limits {
  std::uint32_t sysclk_max_hz;            ///< without overdrive
  std::uint32_t sysclk_overdrive_max_hz;  ///< sysclk_max_hz if there is no overdrive
  std::uint32_t apb1_max_hz;
  std::uint32_t apb2_max_hz;
  std::uint32_t hz_per_wait_state = 30'000'000;  ///< wait states = ceil(HCLK / this) - 1
  std::uint32_t wait_states_max;
  std::uint32_t vco_in_min_hz = 1'000'000, vco_in_max_hz = 2'000'000;  ///< after M
  std::uint32_t vco_min_hz = 100'000'000, vco_max_hz = 432'000'000;    ///< after N
  std::uint32_t n_min = 50, n_max = 432;
  std::uint32_t flash_bytes;
  const Sector* sectors;
  std::uint32_t sector_count;
  std::uint32_t unique_id_address;  ///< 12 bytes
  std::uint32_t dbgmcu_id;          ///< DEV_ID, bits 0 to 11 of DBGMCU_IDCODE (0xE0042000)
  char last_port;                   ///< last GPIO port; the first is A
};

inline constexpr std::uint32_t kFlashBase = 0x08000000;
inline constexpr std::uint32_t kHsi_hz = 16000000;
/// DS8626 table "LSI oscillator characteristics".
inline constexpr std::uint32_t kLsi_hz = 32000, kLsiMin_hz = 17000, kLsiMax_hz = 47000;

/// RM0090 table 5, RM0390 table 4: sectors of 16, 64, 128 KB.
inline constexpr Sector kSectorsF405[] = {
    {0x08000000, 0x4000},  {0x08004000, 0x4000},  {0x08008000, 0x4000},  {0x0800C000, 0x4000},
    {0x08010000, 0x10000}, {0x08020000, 0x20000}, {0x08040000, 0x20000}, {0x08060000, 0x20000},
    {0x08080000, 0x20000}, {0x080A0000, 0x20000}, {0x080C0000, 0x20000}, {0x080E0000, 0x20000},
};
/// RM0385 table 3: sectors of 32, 128, 256 KB.
inline constexpr Sector kSectorsF746[] = {
    {0x08000000, 0x8000},  {0x08008000, 0x8000},  {0x08010000, 0x8000},  {0x08018000, 0x8000},
    {0x08020000, 0x20000}, {0x08040000, 0x40000}, {0x08080000, 0x40000}, {0x080C0000, 0x40000},
};

/// DS8626 (STM32F405), RM0090 3.5.1 and 7.3.2.
inline constexpr Limits kLimitsF405 = {.sysclk_max_hz = 168000000,
                                       .sysclk_overdrive_max_hz = 168000000,
                                       .apb1_max_hz = 42000000,
                                       .apb2_max_hz = 84000000,
                                       .wait_states_max = 7,
                                       .flash_bytes = 0x100000,
                                       .sectors = kSectorsF405,
                                       .sector_count = 12,
                                       .unique_id_address = 0x1FFF7A10,
                                       .dbgmcu_id = 0x413,
                                       .last_port = 'I'};
/// DS10693 (STM32F446), RM0390 3.4.1 and 6.3.2.
inline constexpr Limits kLimitsF446 = {.sysclk_max_hz = 168000000,
                                       .sysclk_overdrive_max_hz = 180000000,
                                       .apb1_max_hz = 45000000,
                                       .apb2_max_hz = 90000000,
                                       .wait_states_max = 15,
                                       .flash_bytes = 0x80000,
                                       .sectors = kSectorsF405,
                                       .sector_count = 8,
                                       .unique_id_address = 0x1FFF7A10,
                                       .dbgmcu_id = 0x421,
                                       .last_port = 'H'};
/// DS10916 (STM32F746), RM0385 3.3.2 and 5.3.2.
inline constexpr Limits kLimitsF746 = {.sysclk_max_hz = 180000000,
                                       .sysclk_overdrive_max_hz = 216000000,
                                       .apb1_max_hz = 54000000,
                                       .apb2_max_hz = 108000000,
                                       .wait_states_max = 9,
                                       .flash_bytes = 0x100000,
                                       .sectors = kSectorsF746,
                                       .sector_count = 8,
                                       .unique_id_address = 0x1FF0F420,
                                       .dbgmcu_id = 0x449,
                                       .last_port = 'K'};

constexpr const Limits& limits(Family family) {
  return family == Family::kF405   ? kLimitsF405
         : family == Family::kF446 ? kLimitsF446
                                   : kLimitsF746;
}

}  // namespace verp::hal::stm32
