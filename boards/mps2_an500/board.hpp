#pragma once

/// Arm MPS2 FPGA board with the AN500 image (Cortex-M7), as QEMU's mps2-an500 emulates it.
namespace verp::board {
inline constexpr const char* kName = "mps2_an500";
inline constexpr const char* kCore = "Cortex-M7";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 256;
}  // namespace verp::board
