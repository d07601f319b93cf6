#pragma once
#include <cstdint>

#include "firmware/boot/boot.hpp"

/// The crash that ended the previous run, kept in memory that survives a reset but not a power
/// loss.
namespace verp::boot {

struct CrashRecord {
  std::uint32_t pc = 0;
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if the cause says it is valid
  std::uint32_t stack_overflow = 0;
  std::uint32_t tick = 0;     ///< last argument of note_tick()
  std::uint32_t crashes = 0;  ///< in a row, since a run that called forget_crashes()
};

/// Call once a tick, so that a crash record names its tick.
void note_tick(std::uint32_t tick);
void keep_crash(const FaultReport& report);
/// Call once after a start. False: the previous run did not crash, or power was lost. Returns a
/// record once.
bool take_crash(CrashRecord& record);
/// Resets the crash count; this run is considered healthy.
void forget_crashes();

}  // namespace verp::boot
