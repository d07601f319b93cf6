#pragma once
#include <cstdint>

#include "hal/chip/sja1000/sja1000.hpp"

/// The SJA1000 of a kvaser_pci card in QEMU's `virt`. Addresses: QEMU's hw/riscv/virt.c (memory
/// map), hw/net/can/can_kvaser_pci.c (card), and the RISC-V PLIC and CLINT specifications.
namespace verp::board {

class KvaserIo {
 public:
  std::uint8_t read8(std::uint32_t offset) { return at<std::uint8_t>(kChip + offset); }
  void write8(std::uint32_t offset, std::uint8_t value) {
    at<std::uint8_t>(kChip + offset) = value;
  }

  /// The core's view: reading the timer's registers would stop QEMU's other threads. Call at least
  /// every seven minutes.
  std::uint64_t now_us() {
    std::uint32_t low;
    __asm__ volatile(".option push\n .option arch, +zicsr\n csrr %0, time\n .option pop"
                     : "=r"(low));
    if (low < static_cast<std::uint32_t>(time_)) time_ += std::uint64_t{1} << 32;
    time_ = (time_ >> 32) << 32 | low;
    return time_ / kTicksPerUs;
  }

  // Interrupts only end a sleep: machine mode never takes one.
  bool mask_interrupts() { return false; }
  void unmask_interrupts() {}
  void doze_until(std::uint64_t us) {
    set_alarm(us * kTicksPerUs);
    __asm__ volatile("wfi" ::: "memory");
    // The caller serves the chip next, so its line falls.
    if (const std::uint32_t source = at<std::uint32_t>(kPlicClaim); source != 0) {
      at<std::uint32_t>(kPlicClaim) = source;
    }
  }

  /// Enables the card's interrupt. False: no card (-device kvaser_pci).
  static bool plug_in() {
    for (std::uint32_t slot = 0; slot < 32; ++slot) {
      const std::uint32_t config = kConfigSpace + (slot << 15);
      if (at<std::uint32_t>(config) != kCard) continue;
      at<std::uint32_t>(config + 0x10) = kBridgePort;
      at<std::uint32_t>(config + 0x14) = kChipPort;
      at<std::uint32_t>(config + 0x18) = kChipPort + 0x100;
      at<std::uint16_t>(config + 0x04) = 1;  // I/O addresses on
      at<std::uint32_t>(kPorts + kBridgePort + kBridgeInterrupts) = kBridgeLetsThrough;
      let_through(kFirstPciInterrupt + slot % 4);  // pin A, swizzled by slot
      return true;
    }
    return false;
  }

 private:
  /// An early alarm stays: the sleeper checks the clock. Setting it each time would cost QEMU more
  /// than the sleep.
  void set_alarm(std::uint64_t when) {
    if (time_ < alarm_ && alarm_ <= when) return;
    alarm_ = when;
    at<std::uint32_t>(kTimeCompare + 4) = 0xFFFFFFFFu;  // no half-written value is in the past
    at<std::uint32_t>(kTimeCompare) = static_cast<std::uint32_t>(when);
    at<std::uint32_t>(kTimeCompare + 4) = static_cast<std::uint32_t>(when >> 32);
  }

  static constexpr std::uint32_t kConfigSpace = 0x30000000, kPorts = 0x03000000;
  static constexpr std::uint32_t kCard = 0x840610E8;  ///< device and vendor
  static constexpr std::uint32_t kBridgePort = 0x1000, kChipPort = 0x1100;
  static constexpr std::uint32_t kChip = kPorts + kChipPort;
  static constexpr std::uint32_t kBridgeInterrupts = 0x38;  ///< INTCSR of AMCC's S5920
  static constexpr std::uint32_t kBridgeLetsThrough = 0x2000;
  static constexpr std::uint32_t kTimeCompare = 0x02004000;
  static constexpr std::uint32_t kTicksPerUs = 10;
  static constexpr std::uint32_t kPlic = 0x0C000000, kPlicClaim = kPlic + 0x200004;
  static constexpr std::uint32_t kFirstPciInterrupt = 32;
  static constexpr std::uint32_t kTimerAndExternal = 1u << 7 | 1u << 11;  ///< bits of mie

  template <class Word>
  static volatile Word& at(std::uint32_t address) {
    return *reinterpret_cast<volatile Word*>(address);
  }
  static void let_through(std::uint32_t interrupt) {
    at<std::uint32_t>(kPlic + 4 * interrupt) = 1;  // priority
    at<std::uint32_t>(kPlic + 0x2000 + 4 * (interrupt / 32)) = 1u << (interrupt % 32);
    at<std::uint32_t>(kPlic + 0x200000) = 0;  // threshold, hart 0, machine mode
    __asm__ volatile(".option push\n .option arch, +zicsr\n csrs mie, %0\n .option pop" ::"r"(
        kTimerAndExternal));
  }

  std::uint64_t time_ = 0;   ///< last read
  std::uint64_t alarm_ = 0;  ///< the timer's compare value
};

using Can = hal::sja1000::Sja1000<KvaserIo>;

inline constexpr CanTiming kCanTiming = Can::timing(16'000'000, 1'000'000);  ///< the card's crystal
static_assert(kCanTiming.possible());

/// False: no card.
inline bool open_can(Can& can) {
  return KvaserIo::plug_in() && can.open(kCanTiming);
}
inline Can make_can() {
  return Can(KvaserIo());
}

}  // namespace verp::board
