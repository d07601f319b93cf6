#pragma once

/// 32-bit RISC-V with soft float: QEMU's machine 'virt'.
namespace verp::board {
inline constexpr const char* kName = "qemu_rv32";
inline constexpr const char* kCore = "RV32IMAC";
inline constexpr int kReplayBlock = 256;
}  // namespace verp::board
