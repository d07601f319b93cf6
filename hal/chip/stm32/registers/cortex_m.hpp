#pragma once
#include "hal/chip/stm32/registers/table.hpp"

/// The core's own registers, by their addresses: Armv7-M Architecture Reference Manual (DDI 0403),
/// B3.2 system control block, B3.3 SysTick, B3.4 NVIC, B3.5 MPU, C1.8 DWT; PM0253 for the caches of
/// the Cortex-M7.
namespace verp::hal::stm32::cortex_m {

inline constexpr std::uint32_t kBase = 0xE000E000;

inline constexpr std::uint32_t kSystCsr = 0xE000E010, kSystRvr = 0xE000E014, kSystCvr = 0xE000E018,
                               kSystCalib = 0xE000E01C;
inline constexpr std::uint32_t kSystCsrEnable = bit(0), kSystCsrTickint = bit(1),
                               kSystCsrCore = bit(2), kSystCsrCountflag = bit(16);
inline constexpr std::uint32_t kSystMax = 0x00FFFFFF;

/// One bit an interrupt, 32 a register. IPR: one byte an interrupt, the upper 4 bits of it in use.
inline constexpr std::uint32_t kNvicIser = 0xE000E100, kNvicIcer = 0xE000E180,
                               kNvicIspr = 0xE000E200, kNvicIcpr = 0xE000E280,
                               kNvicIabr = 0xE000E300, kNvicIpr = 0xE000E400;
inline constexpr unsigned kPriorityBits = 4;

inline constexpr std::uint32_t kCpuid = 0xE000ED00, kIcsr = 0xE000ED04, kVtor = 0xE000ED08,
                               kAircr = 0xE000ED0C, kScr = 0xE000ED10, kCcr = 0xE000ED14,
                               kShpr1 = 0xE000ED18, kShpr2 = 0xE000ED1C, kShpr3 = 0xE000ED20,
                               kShcsr = 0xE000ED24, kCfsr = 0xE000ED28, kHfsr = 0xE000ED2C,
                               kDfsr = 0xE000ED30, kMmfar = 0xE000ED34, kBfar = 0xE000ED38,
                               kCpacr = 0xE000ED88;
inline constexpr std::uint32_t kAircrKey = 0x05FA0000, kAircrSysresetreq = bit(2);
inline constexpr std::uint32_t kShcsrMemfaultena = bit(16), kShcsrBusfaultena = bit(17),
                               kShcsrUsgfaultena = bit(18);
inline constexpr std::uint32_t kCcrIc = bit(17), kCcrDc = bit(16), kCcrDiv0Trp = bit(4),
                               kCcrUnalignTrp = bit(3);
inline constexpr std::uint32_t kCfsrMmarvalid = bit(7), kCfsrBfarvalid = bit(15);
inline constexpr std::uint32_t kCpacrFpu = bits(20, 4);

inline constexpr std::uint32_t kMpuType = 0xE000ED90, kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98,
                               kMpuRbar = 0xE000ED9C, kMpuRasr = 0xE000EDA0;
inline constexpr std::uint32_t kMpuCtrlEnable = bit(0), kMpuCtrlHfnmiena = bit(1),
                               kMpuCtrlPrivdefena = bit(2);
/// A region has 2 << SIZE bytes, at least 32, and begins at a multiple of its size.
inline constexpr std::uint32_t kMpuRasrEnable = bit(0), kMpuRasrXn = bit(28),
                               kMpuRasrApNone = 0u << 24, kMpuRasrApReadWrite = 3u << 24,
                               kMpuRasrB = bit(16), kMpuRasrC = bit(17), kMpuRasrS = bit(18);
inline constexpr unsigned kMpuRasrSizeShift = 1, kMpuRasrTexShift = 19;

inline constexpr std::uint32_t kDemcr = 0xE000EDFC, kDwtCtrl = 0xE0001000, kDwtCyccnt = 0xE0001004,
                               kDwtLar = 0xE0001FB0;
inline constexpr std::uint32_t kDemcrTrcena = bit(24), kDwtCtrlCyccntena = bit(0),
                               kDwtLarUnlock = 0xC5ACCE55;

/// Cortex-M7 only.
inline constexpr std::uint32_t kCcsidr = 0xE000ED80, kCsselr = 0xE000ED84, kIciallu = 0xE000EF50,
                               kDccmvac = 0xE000EF68, kDcimvac = 0xE000EF5C, kDcisw = 0xE000EF60,
                               kDccisw = 0xE000EF74;

}  // namespace verp::hal::stm32::cortex_m
