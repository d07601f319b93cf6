#pragma once
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/cortex_m.hpp"

namespace verp::hal::stm32 {

/// Masks interrupts during its lifetime.
template <Io Access>
class Masked {
 public:
  explicit Masked(Access io) : io_(io), were_on_(io_.mask_interrupts()) {}
  ~Masked() {
    if (were_on_) io_.unmask_interrupts();
  }
  Masked(const Masked&) = delete;
  Masked& operator=(const Masked&) = delete;

 private:
  [[no_unique_address]] Access io_;
  bool were_on_;
};

/// Priority 0 is the most urgent, 15 the least.
template <Io Access>
void enable_interrupt(Access io, unsigned number, std::uint8_t priority) {
  io.write8(cortex_m::kNvicIpr + number,
            static_cast<std::uint8_t>(priority << (8 - cortex_m::kPriorityBits)));
  io.write32(cortex_m::kNvicIser + 4 * (number / 32), 1u << (number % 32));
}

}  // namespace verp::hal::stm32
