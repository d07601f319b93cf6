#pragma once
#include <cstdint>

/// Arm MPS3 with the AN547 image (Cortex-M55), as QEMU's mps3-an547.
namespace verp::board {
inline constexpr const char* kName = "mps3_an547";
inline constexpr const char* kCore = "Cortex-M55";
inline constexpr int kReplayBlock = 256;
/// For fault tests: an address without memory, the end of the code region.
inline constexpr std::uintptr_t kNowhere = 0x1FFFFFF0;
}  // namespace verp::board
