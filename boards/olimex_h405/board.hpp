#pragma once

/// Olimex STM32-H405: STM32F405RGT6 (Cortex-M4F). QEMU's netduinoplus2 has the same chip.
namespace verp::board {
inline constexpr const char* kName = "olimex_h405";
inline constexpr const char* kCore = "Cortex-M4F";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 64;
}  // namespace verp::board
