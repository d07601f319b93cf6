#pragma once
#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/cortex_m.hpp"

namespace verp::hal::stm32 {

/// Cortex-M7: at 216 MHz the flash has 7 wait states. The data cache stays off: variables lie in
/// DTCM, and the flash that the Store writes must read back as written. PM0253 4.8.
template <Io Access>
void enable_instruction_cache(Access io) {
  io.barrier();
  io.write32(cortex_m::kIciallu, 0);  // contents are undefined after power-up
  io.barrier();
  modify32(io, cortex_m::kCcr, 0, cortex_m::kCcrIc);
  io.barrier();
}

}  // namespace verp::hal::stm32
