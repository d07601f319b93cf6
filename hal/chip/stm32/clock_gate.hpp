#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"

namespace verp::hal::stm32 {

/// `enable_register` is an offset such as rcc::kApb1enr.
template <Io Access>
void enable_clock(Access io, std::uint32_t enable_register, std::uint32_t mask) {
  modify32(io, base::kRcc + enable_register, 0, mask);
  io.read32(base::kRcc + enable_register);  // the clock starts two cycles later (RM0090 7.2.14)
}

}  // namespace verp::hal::stm32
