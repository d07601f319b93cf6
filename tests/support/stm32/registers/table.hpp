#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/registers/bits.hpp"

/// The registers of one kind of peripheral as its reference manual lists them; the models check
/// every driver access against them. Offsets and bits are the driver's, from
/// hal/chip/stm32/registers.
namespace verp::hal::stm32 {

/// Access types have the manuals' abbreviations ("List of abbreviations for registers"). A bit in
/// no mask is reserved and must keep its reset value.
struct Register {
  const char* name = nullptr;
  std::uint32_t offset = 0;     ///< bytes from the peripheral's base
  std::uint32_t paragraph = 0;  ///< within the manual's section of this table
  std::uint32_t reset = 0;      ///< value after a system reset
  std::uint32_t rw = 0;         ///< software reads and writes
  std::uint32_t r = 0;          ///< software only reads
  std::uint32_t w = 0;          ///< software only writes; reads are undefined
  std::uint32_t rs = 0;         ///< software reads and sets; writing 0 has no effect
  std::uint32_t rc_w0 = 0;      ///< software reads, and clears by writing 0; 1 has no effect
  std::uint32_t rc_w1 = 0;      ///< software reads, and clears by writing 1; 0 has no effect
  std::uint32_t rc_r = 0;       ///< software reads, which clears

  constexpr std::uint32_t defined() const { return rw | r | w | rs | rc_w0 | rc_w1 | rc_r; }
};

struct Table {
  const char* name;
  const char* manuals;  ///< section in each family's manual, "-" if the family has another table
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
