#pragma once
#include <cstdint>
#include <map>

#include "hal/chip/stm32/registers/cortex_m.hpp"
#include "tests/support/stm32/time.hpp"

/// SysTick (by polling), the cycle counter, NVIC enables and software-pended interrupts, AIRCR's
/// reset. MPU, caches and fault handling have no effect.
namespace verp::hal::stm32::model {

class Machine;

class CoreModel {
 public:
  explicit CoreModel(Machine& machine) : machine_(machine) {}
  bool holds(std::uint32_t address) const { return address >= 0xE0000000; }
  std::uint32_t read(std::uint32_t address);
  void write(std::uint32_t address, std::uint32_t value);
  void reset();

  bool enabled(unsigned irq) const { return (enabled_[irq / 32] >> (irq % 32) & 1u) != 0; }
  bool pended(unsigned irq) const { return (pended_[irq / 32] >> (irq % 32) & 1u) != 0; }
  void unpend(unsigned irq) { pended_[irq / 32] &= ~(1u << (irq % 32)); }
  std::uint32_t remembered(std::uint32_t address) const;

 private:
  std::uint32_t systick_count() const;

  Machine& machine_;
  std::uint32_t enabled_[8] = {};
  std::uint32_t pended_[8] = {};
  std::uint64_t systick_from_ = 0;  ///< core cycles at the last write
  std::uint64_t systick_flagged_ = 0;
  std::uint64_t cycle_offset_ = 0;
  std::map<std::uint32_t, std::uint32_t> words_;
};

}  // namespace verp::hal::stm32::model
