#pragma once
#include <cstdint>

/// Arm MPS2 with the AN386 image (Cortex-M4F), as QEMU's mps2-an386.
namespace verp::board {
inline constexpr const char* kName = "mps2_an386";
inline constexpr const char* kCore = "Cortex-M4F";
inline constexpr int kReplayBlock = 256;
/// For fault tests: an address without memory (no external memory).
inline constexpr std::uintptr_t kNowhere = 0x6FFFFFF0;
}  // namespace verp::board
