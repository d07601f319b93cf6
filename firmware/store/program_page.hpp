#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/flash_pages.hpp"

namespace verp::store {

/// Programs `size` bytes from `offset` on, which was erased, a multiple of the unit, and compares.
/// False: the memory did not take them, or has no room. `idle()` is called after each unit: units
/// may take longer together than a watchdog waits. `take(at, to, count)`: the bytes from `at` on.
template <hal::FlashPages Flash, class Take, class Idle>
bool program_part(Flash& flash, std::size_t page, std::size_t offset, std::size_t size, Take&& take,
                  Idle&& idle) {
  if (offset + size > flash.page_bytes(page)) return false;
  for (std::size_t at = 0; at < size; at += Flash::kUnit) {
    std::uint8_t unit[Flash::kUnit];
    const std::size_t count = size - at < sizeof unit ? size - at : sizeof unit;
    __builtin_memset(unit, 0xFF, sizeof unit);
    take(at, unit, count);
    if (!flash.program(page, offset + at, unit)) return false;
    std::uint8_t there[Flash::kUnit];
    flash.read(page, offset + at, there, count);
    if (__builtin_memcmp(there, unit, count) != 0) return false;
    idle();
  }
  return true;
}

/// Replaces what a page of flash begins with: erases it, and programs `size` bytes. Takes seconds,
/// in which the processor may stand still (hal/contract/flash_pages.hpp). False: the memory did not
/// take them, or has no room; what is there then, as after a loss of power, is for the reader's own
/// check (CRC) to find out.
template <hal::FlashPages Flash, class Idle>
bool program_page(Flash& flash, std::size_t page, const std::uint8_t* bytes, std::size_t size,
                  Idle&& idle) {
  if (size > flash.page_bytes(page) || !flash.erase(page)) return false;
  const auto take = [bytes](std::size_t at, std::uint8_t* to, std::size_t count) {
    __builtin_memcpy(to, bytes + at, count);
  };
  return program_part(flash, page, 0, size, take, idle);
}

/// Bytes of a page.
struct Part {
  std::size_t offset = 0;
  std::size_t size = 0;
};

/// The same, and `kept`, which stands behind them in the page, is there afterwards too: it waits in
/// page `spare` of `other`, whose content is lost, but never looks like a log's (record.hpp). False
/// with the page untouched if that did not take it. A loss of power can cost either part, but
/// leaves neither looking sound that is not, as each has a check of its own.
template <hal::FlashPages Flash, hal::FlashPages Other, class Idle>
bool program_beside(Flash& flash, std::size_t page, const std::uint8_t* bytes, std::size_t size,
                    Part kept, Other& other, std::size_t spare, Idle&& idle) {
  constexpr std::size_t kBehindHeader = 64;
  const auto from = [](auto& memory, std::size_t where, std::size_t offset) {
    return [&memory, where, offset](std::size_t at, std::uint8_t* to, std::size_t count) {
      memory.read(where, offset + at, to, count);
    };
  };
  if (kept.size == 0) return program_page(flash, page, bytes, size, idle);
  if (size > kept.offset || kept.offset + kept.size > flash.page_bytes(page)) return false;
  return other.erase(spare) &&
         program_part(other, spare, kBehindHeader, kept.size, from(flash, page, kept.offset),
                      idle) &&
         program_page(flash, page, bytes, size, idle) &&
         program_part(flash, page, kept.offset, kept.size, from(other, spare, kBehindHeader), idle);
}

}  // namespace verp::store
