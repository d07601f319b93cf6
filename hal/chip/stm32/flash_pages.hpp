#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/flash.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "hal/contract/flash_pages.hpp"

/// Two sectors of the chip's own flash as FlashPages. An erase stalls the processor: received bytes
/// may be lost. Programming 32-bit words needs 2.7 to 3.6 V. `Timer` is a TickTimer, `Dog` an
/// IndependentWatchdog.
namespace verp::hal::stm32 {

template <Io Access, class Timer, class Dog>
class SectorPages {
 public:
  static constexpr std::size_t kUnit = 4;

  /// `first`, `second`: sector numbers of pages 0 and 1 (kSector..., memory_map.hpp).
  SectorPages(Family family, std::uint8_t first, std::uint8_t second, Timer& timer, Dog& dog,
              Access io = {})
      : io_(io), family_(family), sector_{first, second}, timer_(timer), dog_(dog) {}

  std::size_t page_bytes(std::size_t page) const { return place(page).bytes; }
  /// The page's address as memory.
  const std::uint8_t* memory(std::size_t page) const {
    return reinterpret_cast<const std::uint8_t*>(std::uintptr_t{place(page).address});
  }

  void read(std::size_t page, std::size_t offset, std::uint8_t* to, std::size_t size) const {
    const auto from = static_cast<std::uint32_t>(place(page).address + offset);
    for (std::uint32_t i = 0; i < size; ++i) to[i] = io_.read8(from + i);
  }

  bool program(std::size_t page, std::size_t offset, const std::uint8_t* from) {
    if (page > 1 || offset % kUnit != 0 || offset + kUnit > page_bytes(page) || !open())
      return false;
    const auto address = static_cast<std::uint32_t>(place(page).address + offset);
    std::uint32_t word = 0;
    __builtin_memcpy(&word, from, sizeof word);
    const std::uint32_t there = io_.read32(address);
    modify32(io_, at(flash::kCr), flash::kCrPsize | flash::kCrSer | flash::kCrMer,
             kWords | flash::kCrPg);
    io_.write32(address, word);
    io_.barrier();
    const bool good = wait_programmed() && no_errors();
    close(flash::kCrPg);
    return good && io_.read32(address) == (there & word);
  }

  bool erase(std::size_t page) {
    if (page > 1 || !open()) return false;
    dog_.stretch();
    cache_data(false);
    modify32(io_, at(flash::kCr), flash::kCrPsize | flash::kCrSnb | flash::kCrPg | flash::kCrMer,
             kWords | std::uint32_t{sector_[page]} << flash::kCrSnbShift | flash::kCrSer);
    modify32(io_, at(flash::kCr), 0, flash::kCrStrt);
    io_.barrier();
    const bool good = wait_erased() && no_errors();
    close(flash::kCrSer | flash::kCrSnb);
    cache_data(true);
    dog_.relax();
    return good;
  }

 private:
  static constexpr std::uint32_t kWords = flash::kPsize32 << flash::kCrPsizeShift;
  /// 100 us (DS8626, flash memory programming); a poll takes at least 10 cycles of 216 MHz.
  static constexpr std::uint32_t kProgramPolls = 20'000;
  /// 2 s for 128 KB on an F4, 4 s for 256 KB on an F7 (DS10916), plus half.
  static constexpr std::uint64_t kErase_us = 6'000'000;

  static std::uint32_t at(std::uint32_t offset) { return base::kFlash + offset; }
  const Sector& place(std::size_t page) const {
    return limits(family_).sectors[sector_[page == 0 ? 0 : 1]];
  }
  bool busy() { return (io_.read32(at(flash::kSr)) & flash::kSrBsy) != 0; }
  bool no_errors() { return (io_.read32(at(flash::kSr)) & flash::kSrErrors) == 0; }

  /// Clears errors, unlocks. False: busy or still locked.
  bool open() {
    if (busy()) return false;
    io_.write32(at(flash::kSr), flash::kSrErrors | flash::kSrEop);
    if ((io_.read32(at(flash::kCr)) & flash::kCrLock) != 0) {
      io_.write32(at(flash::kKeyr), flash::kKey1);
      io_.write32(at(flash::kKeyr), flash::kKey2);
    }
    return (io_.read32(at(flash::kCr)) & flash::kCrLock) == 0;
  }
  // A locked flash ignores stray writes.
  void close(std::uint32_t command) {
    if (busy()) return;
    modify32(io_, at(flash::kCr), command, 0);
    modify32(io_, at(flash::kCr), 0, flash::kCrLock);
  }
  bool wait_programmed() {
    for (std::uint32_t poll = 0; poll < kProgramPolls; ++poll) {
      if (!busy()) return true;
    }
    return false;
  }
  bool wait_erased() {
    const std::uint64_t deadline_us = timer_.now_us() + kErase_us;
    while (busy()) {
      const std::uint64_t now_us = timer_.now_us();
      if (now_us >= deadline_us) return false;
      timer_.doze_until(now_us + 1000, [] { return false; });
    }
    return true;
  }
  // The F4's data cache may hold erased contents (RM0090 3.5.2); flush it while off.
  void cache_data(bool on) {
    if (family_ == Family::kF746) return;
    if (!on) {
      modify32(io_, at(flash::kAcr), flash::kAcrDcenF4, 0);
      return;
    }
    modify32(io_, at(flash::kAcr), 0, flash::kAcrDcrstF4);
    modify32(io_, at(flash::kAcr), flash::kAcrDcrstF4, 0);
    modify32(io_, at(flash::kAcr), 0, flash::kAcrDcenF4);
  }

  [[no_unique_address]] mutable Access io_;
  Family family_;
  std::uint8_t sector_[2];
  Timer& timer_;
  Dog& dog_;
};

}  // namespace verp::hal::stm32
