#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Armv7-M Architecture Reference Manual (DDI 0403) B3.2 system control block, B3.3 SysTick, B3.4
/// NVIC, B3.5 MPU, C1.8 DWT; PM0253 for the Cortex-M7 caches.
namespace verp::hal::stm32::cortex_m {

inline constexpr std::uint32_t kSystCsr = 0xE000E010, kSystRvr = 0xE000E014, kSystCvr = 0xE000E018;
inline constexpr std::uint32_t kSystCsrEnable = bit(0), kSystCsrTickint = bit(1),
                               kSystCsrCore = bit(2), kSystCsrCountflag = bit(16);
inline constexpr std::uint32_t kSystMax = 0x00FFFFFF;

/// One bit per interrupt. IPR: a byte per interrupt; its upper 4 bits count.
inline constexpr std::uint32_t kNvicIser = 0xE000E100, kNvicIcer = 0xE000E180,
                               kNvicIspr = 0xE000E200, kNvicIcpr = 0xE000E280,
                               kNvicIpr = 0xE000E400;
inline constexpr unsigned kPriorityBits = 4;

inline constexpr std::uint32_t kAircr = 0xE000ED0C, kCcr = 0xE000ED14, kCfsr = 0xE000ED28,
                               kMmfar = 0xE000ED34, kBfar = 0xE000ED38;
inline constexpr std::uint32_t kAircrKey = 0x05FA0000, kAircrSysresetreq = bit(2);
inline constexpr std::uint32_t kCcrIc = bit(17), kCcrDc = bit(16);

inline constexpr std::uint32_t kMpuType = 0xE000ED90, kMpuCtrl = 0xE000ED94, kMpuRnr = 0xE000ED98,
                               kMpuRbar = 0xE000ED9C, kMpuRasr = 0xE000EDA0;
/// An MPU region has 2 << SIZE bytes, at least 32, and starts at a multiple of that.

inline constexpr std::uint32_t kDemcr = 0xE000EDFC, kDwtCtrl = 0xE0001000, kDwtCyccnt = 0xE0001004;
inline constexpr std::uint32_t kDemcrTrcena = bit(24), kDwtCtrlCyccntena = bit(0);

/// Cortex-M7 only.
inline constexpr std::uint32_t kIciallu = 0xE000EF50;

}  // namespace verp::hal::stm32::cortex_m
