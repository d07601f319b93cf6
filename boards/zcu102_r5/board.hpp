#pragma once

/// AMD ZCU102, first Cortex-R5F of its Zynq UltraScale+, as QEMU's xlnx-zcu102 emulates it.
namespace verp::board {
inline constexpr const char* kName = "zcu102_r5";
inline constexpr const char* kCore = "Cortex-R5F";
inline constexpr int kReplayBlock = 256;
}  // namespace verp::board
