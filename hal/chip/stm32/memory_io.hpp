#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/io.hpp"

/// The real chip: volatile accesses and Armv7-M instructions (Armv7-M Architecture Reference
/// Manual, A7.7 DSB, WFI, CPS).
namespace verp::hal::stm32 {

class MemoryIo {
 public:
  std::uint8_t read8(std::uint32_t address) { return at<std::uint8_t>(address); }
  std::uint16_t read16(std::uint32_t address) { return at<std::uint16_t>(address); }
  std::uint32_t read32(std::uint32_t address) { return at<std::uint32_t>(address); }
  void write8(std::uint32_t address, std::uint8_t value) { at<std::uint8_t>(address) = value; }
  void write16(std::uint32_t address, std::uint16_t value) { at<std::uint16_t>(address) = value; }
  void write32(std::uint32_t address, std::uint32_t value) { at<std::uint32_t>(address) = value; }

  std::uint32_t bus_address(const void* data, std::size_t) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(data));
  }
  void barrier() { asm volatile("dsb" ::: "memory"); }
  bool mask_interrupts() {
    std::uint32_t primask = 0;
    asm volatile("mrs %0, primask" : "=r"(primask));
    asm volatile("cpsid i" ::: "memory");
    return (primask & 1u) == 0;
  }
  void unmask_interrupts() { asm volatile("cpsie i" ::: "memory"); }
  void wait_for_interrupt() { asm volatile("wfi" ::: "memory"); }

 private:
  template <class Word>
  static volatile Word& at(std::uint32_t address) {
    return *reinterpret_cast<volatile Word*>(static_cast<std::uintptr_t>(address));
  }
};

static_assert(Io<MemoryIo>);

}  // namespace verp::hal::stm32
