#pragma once

/// RISC-V with 32 bits and soft float: QEMU's machine 'virt'.
namespace verp::board {
inline constexpr const char* kName = "qemu_rv32";
inline constexpr const char* kCore = "RV32IMAC";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 256;
}  // namespace verp::board
