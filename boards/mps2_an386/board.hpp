#pragma once

/// Arm MPS2 FPGA board with the AN386 image (Cortex-M4F), as QEMU's mps2-an386 emulates it.
namespace verp::board {
inline constexpr const char* kName = "mps2_an386";
inline constexpr const char* kCore = "Cortex-M4F";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 256;
}  // namespace verp::board
