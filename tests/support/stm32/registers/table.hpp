#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/registers/bits.hpp"

/// A peripheral's registers as its reference manual lists them; models check every access against
/// them. Offsets and bits: hal/chip/stm32/registers.
namespace verp::hal::stm32 {

/// Access types have the manuals' abbreviations ("List of abbreviations for registers"). A bit in
/// no mask is reserved and keeps its reset value.
struct Register {
  const char* name = nullptr;
  std::uint32_t offset = 0;     ///< bytes from the base
  std::uint32_t paragraph = 0;  ///< within the manual's section
  std::uint32_t reset = 0;      ///< after a system reset
  std::uint32_t rw = 0;         ///< software reads and writes
  std::uint32_t r = 0;          ///< software only reads
  std::uint32_t w = 0;          ///< software only writes
  std::uint32_t rs = 0;         ///< read and set; writing 0 has no effect
  std::uint32_t rc_w0 = 0;      ///< read, and cleared by 0; 1 has no effect
  std::uint32_t rc_w1 = 0;      ///< read, and cleared by 1; 0 has no effect
  std::uint32_t rc_r = 0;       ///< a read clears

  constexpr std::uint32_t defined() const { return rw | r | w | rs | rc_w0 | rc_w1 | rc_r; }
};

struct Table {
  const char* name;
  const char* manuals;  ///< section per family, "-": another table
  const Register* first;
  std::size_t count;

  constexpr const Register* begin() const { return first; }
  constexpr const Register* end() const { return first + count; }
};

template <std::size_t kCount>
constexpr Table make_table(const char* name, const char* manuals,
                           const Register (&registers)[kCount]) {
  return {name, manuals, registers, kCount};
}

}  // namespace verp::hal::stm32
