#pragma once
#include <cstdint>

#include "firmware/boot/boot.hpp"

/// What is known of the crash that ended the run before, kept in memory that survives a reset and
/// not the loss of power.
namespace verp::boot {

struct CrashRecord {
  std::uint32_t pc = 0;
  std::uint32_t lr = 0;
  std::uint32_t cause = 0;    ///< CFSR
  std::uint32_t address = 0;  ///< BFAR or MMFAR, if the cause says so
  std::uint32_t stack_overflow = 0;
  std::uint32_t tick = 0;     ///< what note_tick() was told last
  std::uint32_t crashes = 0;  ///< in a row: since a run that called forget_crashes()
};

/// Call once a tick: a crash then says when it was.
void note_tick(std::uint32_t tick);
/// From the fault handler, before the reset.
void keep_crash(const FaultReport& report);
/// Once after a start. False: the run before did not crash, or the power was gone. A record is
/// given once.
bool take_crash(CrashRecord& record);
/// This run has come so far that the crashes before it are history.
void forget_crashes();

}  // namespace verp::boot
