#pragma once
#include <cstdint>
#include <string>

#include "hal/chip/stm32/registers/rcc.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/rcc_model.hpp"

namespace verp::hal::stm32::model {

inline constexpr Family kFamilies[] = {Family::kF405, Family::kF446, Family::kF746};

/// As the manual asks: set the bit, read it back.
inline void enable(ModelIo& io, std::uint32_t offset, std::uint32_t mask) {
  modify32(io, base::kRcc + offset, 0, mask);
  io.read32(base::kRcc + offset);
}

inline bool wait_set(Machine& machine, std::uint32_t address, std::uint32_t mask, Time limit) {
  ModelIo io = machine.io();
  const Time end = machine.now() + limit;
  while (machine.now() < end) {
    if ((io.read32(address) & mask) == mask) return true;
  }
  return false;
}
inline bool wait_clear(Machine& machine, std::uint32_t address, std::uint32_t mask, Time limit) {
  ModelIo io = machine.io();
  const Time end = machine.now() + limit;
  while (machine.now() < end) {
    if ((io.read32(address) & mask) == 0) return true;
  }
  return false;
}

/// Exactly one new violation, with this text.
inline bool one_violation(Machine& machine, const std::string& part) {
  const bool one =
      machine.violations().size() == 1 && machine.violations()[0].find(part) != std::string::npos;
  if (one) machine.forget_violations();
  return one;
}

}  // namespace verp::hal::stm32::model
