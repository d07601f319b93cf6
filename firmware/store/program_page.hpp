#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/flash_pages.hpp"

namespace verp::store {

/// Replaces what a page of flash begins with: erases it, programs `size` bytes and compares. Takes
/// seconds, in which the processor may stand still (hal/contract/flash_pages.hpp). False: the
/// memory did not take them, or has no room; what is there then, as after a loss of power, is for
/// the reader's own check (CRC) to find out. `idle()` is called after each unit: units may take
/// longer together than a watchdog waits.
template <hal::FlashPages Flash, class Idle>
bool program_page(Flash& flash, std::size_t page, const std::uint8_t* bytes, std::size_t size,
                  Idle&& idle) {
  if (size > flash.page_bytes(page) || !flash.erase(page)) return false;
  for (std::size_t offset = 0; offset < size; offset += Flash::kUnit) {
    std::uint8_t unit[Flash::kUnit];
    const std::size_t count = size - offset < sizeof unit ? size - offset : sizeof unit;
    __builtin_memset(unit, 0xFF, sizeof unit);
    __builtin_memcpy(unit, bytes + offset, count);
    if (!flash.program(page, offset, unit)) return false;
    std::uint8_t there[Flash::kUnit];
    flash.read(page, offset, there, count);
    if (__builtin_memcmp(there, unit, count) != 0) return false;
    idle();
  }
  return true;
}

}  // namespace verp::store
