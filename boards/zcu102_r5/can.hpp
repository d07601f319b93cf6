#pragma once
#include <cstdint>

#include "hal/chip/zynqmp_can/zynqmp_can.hpp"

/// CAN 0 of the Zynq UltraScale+ in QEMU's xlnx-zcu102. Polled: QEMU has no interrupt controller
/// for its R5s. Addresses: UG1085, table 10-3.
namespace verp::board {

class Can0Io {
 public:
  Can0Io() {
    // PMCR: cycle counter on, every 64th cycle; PMCNTENSET: that counter (ARMv7-AR ARM, B4.1.116).
    __asm__ volatile(
        "mcr p15, 0, %0, c9, c12, 0\n"
        "mcr p15, 0, %1, c9, c12, 1\n" ::"r"(0xDu),
        "r"(1u << 31));
  }
  std::uint32_t read32(std::uint32_t offset) { return at(offset); }
  void write32(std::uint32_t offset, std::uint32_t value) { at(offset) = value; }

  /// By the core's cycle counter: call at least every four minutes. A read costs QEMU several
  /// system calls, so one value serves kStands calls.
  std::uint64_t now_us() {
    if (asked_++ % kStands != 0) return (high_ + last_) * 64 / kCyclesPerUs;
    std::uint32_t count;
    __asm__ volatile("mrc p15, 0, %0, c9, c13, 0" : "=r"(count));
    if (count < last_) high_ += std::uint64_t{1} << 32;
    last_ = count;
    return (high_ + count) * 64 / kCyclesPerUs;
  }
  /// Nothing wakes this core. It counts for some microseconds: polling again at once would stop
  /// QEMU's other threads.
  void doze_until(std::uint64_t) {
    for (int i = 0; i < kPause; ++i) __asm__ volatile("");
    asked_ = 0;
  }

 private:
  static constexpr std::uint32_t kCan0 = 0xFF060000;
  static constexpr int kPause = 1500;
  static constexpr unsigned kStands = 16;
  static constexpr std::uint32_t kCyclesPerUs = 1000;  ///< QEMU counts at 1 GHz for every core
  static volatile std::uint32_t& at(std::uint32_t offset) {
    return *reinterpret_cast<volatile std::uint32_t*>(kCan0 + offset);
  }
  std::uint32_t last_ = 0;
  std::uint64_t high_ = 0;
  unsigned asked_ = 0;
};

using Can = hal::zynqmp_can::ZynqmpCan<Can0Io, hal::zynqmp_can::Layout::kQemu>;

inline constexpr std::uint32_t kCanBitRate_hz = 1'000'000;
/// QEMU's reference clock (hw/arm/xlnx-zynqmp.c); it models no bit timing.
inline constexpr CanTiming kCanTiming = Can::timing(24'000'000, kCanBitRate_hz);
static_assert(kCanTiming.possible());

inline bool open_can(Can& can) {
  return can.open(kCanTiming, kCanBitRate_hz);
}
inline Can make_can() {
  return Can(Can0Io());
}

}  // namespace verp::board
