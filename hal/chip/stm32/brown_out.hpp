#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/flash.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"

namespace verp::hal::stm32 {

enum class BrownOut : std::uint8_t {
  kUnknown = 0,  ///< no flash controller: an emulator
  kKept = 1,     ///< the level stood at this start
  kWritten = 2,  ///< at this start; a chip that says so at every start does not keep it
  kRefused = 3,
};

/// Has the chip reset below 2.7 V, its highest brown-out level. As it is delivered, the chip runs
/// on down to 1.8 V, where flash that is being programmed takes wrong words (SectorPages needs 2.7
/// V). The level is an option byte: it is written once, keeps all other option bits, and holds from
/// the next power-on. RM0090 3.6.5 and 3.9.10, RM0390 3.6 and RM0385 3.4: BOR_LEV 0 is level 3.
/// Writing takes as long as an erase, less than a second; so long it waits. OPTCR reads what was
/// written to it until the next reset, so a refusal shows in SR, or in OPTCR that did not change:
/// with readout protection of level 2 no option can.
template <Io Access>
BrownOut keep_brown_out(Access io) {
  constexpr std::uint32_t at = base::kFlash;
  constexpr int kPolls = 2'000'000;  // a second of the internal oscillator's 16 MHz, at least
  const std::uint32_t options = io.read32(at + flash::kOptcr);
  if (options == 0) return BrownOut::kUnknown;  // OPTLOCK is set after every reset
  if ((options & flash::kOptcrBorLev) == 0) return BrownOut::kKept;
  if ((io.read32(at + flash::kSr) & flash::kSrBsy) != 0) return BrownOut::kRefused;
  io.write32(at + flash::kOptkeyr, flash::kOptKey1);
  io.write32(at + flash::kOptkeyr, flash::kOptKey2);
  modify32(io, at + flash::kOptcr, flash::kOptcrBorLev, 0);
  modify32(io, at + flash::kOptcr, 0, flash::kOptcrOptstrt);
  for (int poll = 0; (io.read32(at + flash::kSr) & flash::kSrBsy) != 0 && poll < kPolls; ++poll) {
  }
  modify32(io, at + flash::kOptcr, 0, flash::kOptcrOptlock);
  const bool refused = (io.read32(at + flash::kSr) & (flash::kSrErrors | flash::kSrBsy)) != 0 ||
                       (io.read32(at + flash::kOptcr) & flash::kOptcrBorLev) != 0;
  return refused ? BrownOut::kRefused : BrownOut::kWritten;
}

}  // namespace verp::hal::stm32
