#pragma once
#include <cstdint>

#include "firmware/boot/boot.hpp"

/// The previous run's crash, in memory that survives a reset, not a power loss.
namespace verp::boot {

struct CrashRecord {
  std::uint32_t pc = 0;
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if valid by the cause
  std::uint32_t stack_overflow = 0;
  std::uint32_t tick = 0;     ///< last argument of note_tick()
  std::uint32_t crashes = 0;  ///< in a row, since forget_crashes()
};

/// Call once a tick, for the crash record.
void note_tick(std::uint32_t tick);
void keep_crash(const FaultReport& report);
/// Call once after a start. False: no crash, or power was lost. Returns a record once.
bool take_crash(CrashRecord& record);
/// Resets the crash count: this run is healthy.
void forget_crashes();

}  // namespace verp::boot
