#pragma once
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/cortex_m.hpp"

namespace verp::hal::stm32 {

/// Switches the Cortex-M7's instruction cache on: at 216 MHz the flash memory has 7 wait states.
/// Code never changes while it runs. The data cache stays off, because nothing would gain by it
/// that is worth its dangers: variables lie in DTCM, which is never cached, and the flash memory
/// that the Store writes must be read back as it is. PM0253 4.8.
template <Io Access>
void enable_instruction_cache(Access io) {
  io.barrier();
  io.write32(cortex_m::kIciallu, 0);  // what it holds after power-up is not code
  io.barrier();
  modify32(io, cortex_m::kCcr, 0, cortex_m::kCcrIc);
  io.barrier();
}

}  // namespace verp::hal::stm32
