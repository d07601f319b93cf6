#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/flash_pages.hpp"

namespace verp::store {

/// Programs `size` bytes from `offset` and verifies them; other bytes of a unit stay. Calls
/// `idle()` after each unit, for the watchdog. False: no room, or the memory did not take them (not
/// erased, or worn).
template <hal::FlashPages Flash, class Idle>
bool program_bytes(Flash& flash, std::size_t page, std::size_t offset, const std::uint8_t* from,
                   std::size_t size, Idle&& idle) {
  if (offset > flash.page_bytes(page) || size > flash.page_bytes(page) - offset) return false;
  for (std::size_t done = 0; done < size;) {
    const std::size_t skipped = (offset + done) % Flash::kUnit;
    const std::size_t room = Flash::kUnit - skipped;
    const std::size_t count = size - done < room ? size - done : room;
    std::uint8_t unit[Flash::kUnit];
    __builtin_memset(unit, 0xFF, sizeof unit);
    __builtin_memcpy(unit + skipped, from + done, count);
    if (!flash.program(page, offset + done - skipped, unit)) return false;
    std::uint8_t there[Flash::kUnit];
    flash.read(page, offset + done, there, count);
    if (__builtin_memcmp(there, unit + skipped, count) != 0) return false;
    done += count;
    idle();
  }
  return true;
}

}  // namespace verp::store
