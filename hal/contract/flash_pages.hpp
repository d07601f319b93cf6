#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// FlashPages: two flash pages, 0 and 1, that are erased separately: sectors of 16 to 128 KB on an
/// STM32F4, 32 to 256 KB on an F7.
///
/// A backend promises:
///  - kUnit: bytes programmed at once: 1, 2, 4 or 8. page_bytes(page): a multiple of 8.
///  - read(page, offset, to, size): any bytes within a page.
///  - program(page, offset, from): writes kUnit bytes at a multiple of kUnit and waits for the end
///    (at most 100 us a unit: DS8626, flash memory programming). It only clears bits: the result is
///    (old & from). Programming a 0 bit again makes it firm. False: the memory reported an error.
///  - erase(page): sets all bits of the page; false as above. It may take seconds (2 s for 128 KB:
///    the same table) in which the processor may stall; the backend keeps the watchdog from firing.
///  - A power cut during program() leaves the changing bits of that unit unsure; during erase(),
///    any bit of the page. An unsure bit may read differently at each start until it is programmed
///    to 0 or erased.
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
