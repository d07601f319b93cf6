#pragma once
#include <cstdint>

/// Arm MPS2 with the AN385 image (Cortex-M3), as QEMU's mps2-an385.
namespace verp::board {
inline constexpr const char* kName = "mps2_an385";
inline constexpr const char* kCore = "Cortex-M3";
inline constexpr int kReplayBlock = 256;
/// For fault tests: an address without memory (no external memory).
inline constexpr std::uintptr_t kNowhere = 0x6FFFFFF0;
}  // namespace verp::board
