#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// FlashPages: two pages of flash memory, numbered 0 and 1, that are erased apart from each other:
/// sectors of 16 to 128 KB on an STM32F4, of 32 to 256 KB on an F7.
///
/// Promises of a backend:
///  - kUnit: bytes programmed at once: 1, 2, 4 or 8. page_bytes(page): a multiple of 8.
///  - read(page, offset, to, size): any bytes within a page.
///  - program(page, offset, from): kUnit bytes at a multiple of kUnit. Programming clears bits and
///    never sets one: what is there becomes (there & from), also when it was programmed before.
///    A bit programmed to 0 once more is firmly 0. False: the memory reported an error. Waits for
///    its end (at most 100 us a unit: DS8626, flash memory programming).
///  - erase(page): sets all bits of the page. False: the memory reported an error. May take seconds
///    (2 s for 128 KB: the same table) in which the processor may stand still; the backend keeps
///    the watchdog from biting meanwhile.
///  - Power that goes during program() leaves in that unit any of the bits that were to change
///    unsure, during erase() any bit of the page: an unsure bit may read differently at each start,
///    until it is programmed to 0 or erased.
/// Implementations: hal/fake/fake_flash.hpp, the flash controllers of hal/chip. User:
/// firmware/store/flash_store.hpp.
namespace verp::hal {

template <class Flash>
concept FlashPages = requires(Flash& flash, const Flash& seen, std::size_t page, std::size_t offset,
                              std::uint8_t* to, const std::uint8_t* from, std::size_t size) {
  requires Flash::kUnit == 1 || Flash::kUnit == 2 || Flash::kUnit == 4 || Flash::kUnit == 8;
  { seen.page_bytes(page) } -> std::same_as<std::size_t>;
  { seen.read(page, offset, to, size) } -> std::same_as<void>;
  { flash.program(page, offset, from) } -> std::same_as<bool>;
  { flash.erase(page) } -> std::same_as<bool>;
};

}  // namespace verp::hal
