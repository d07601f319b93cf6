#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/chip/stm32/registers/rcc.hpp"

namespace verp::hal::stm32 {

enum class ResetCause : std::uint8_t {
  kUnknown = 0,  ///< no flag: an emulator
  kPowerOn = 1,  ///< power-on or brown-out
  kPin = 2,
  kSoftware = 3,
  kWatchdog = 4,  ///< independent or window watchdog
  kLowPower = 5,
};

/// Clears the flags for the next start. If several are set (every reset also pulls the pin), the
/// rarest counts. RM0090 7.3.21.
template <Io Access>
ResetCause take_reset_cause(Access io) {
  const std::uint32_t csr = io.read32(base::kRcc + rcc::kCsr);
  modify32(io, base::kRcc + rcc::kCsr, 0, rcc::kCsrRmvf);
  modify32(io, base::kRcc + rcc::kCsr, rcc::kCsrRmvf, 0);  // left set, it would clear later flags
  if ((csr & (rcc::kCsrIwdgrstf | rcc::kCsrWwdgrstf)) != 0) return ResetCause::kWatchdog;
  if ((csr & rcc::kCsrSftrstf) != 0) return ResetCause::kSoftware;
  if ((csr & rcc::kCsrLpwrrstf) != 0) return ResetCause::kLowPower;
  if ((csr & (rcc::kCsrPorrstf | rcc::kCsrBorrstf)) != 0) return ResetCause::kPowerOn;
  if ((csr & rcc::kCsrPinrstf) != 0) return ResetCause::kPin;
  return ResetCause::kUnknown;
}

}  // namespace verp::hal::stm32
