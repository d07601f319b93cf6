#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/flash_pages.hpp"

/// Flash in RAM with power cuts in the middle of any write. A cut leaves the changing bits unsure:
/// each power_up() decides what they read as, often all alike. A copy is a second flash in the same
/// state.
namespace verp::hal {

template <std::size_t kPageBytes, std::size_t kUnitBytes>
class FakeFlash {
 public:
  static constexpr std::size_t kUnit = kUnitBytes;

  explicit FakeFlash(std::uint32_t seed = 1) : random_(seed | 1u) {
    for (std::size_t i = 0; i < 2 * kPageBytes; ++i) cell_[i] = 0xFF;
  }

  /// Cuts the power in the write that follows `writes` more program() or erase() calls. Nothing is
  /// written after that until power_up().
  void cut_after(std::uint32_t writes) {
    writes_left_ = writes;
    cut_planned_ = true;
  }
  /// Ends the cut and draws new values for the unsure bits.
  void power_up() {
    dark_ = false;
    cut_planned_ = false;
    const std::uint32_t mood = random() % 4;
    for (std::size_t i = 0; i < 2 * kPageBytes; ++i) {
      if (unsure_[i] == 0) continue;
      const auto fallen =
          static_cast<std::uint8_t>(mood == 0 ? 0xFFu : (mood == 1 ? 0u : random()));
      cell_[i] = static_cast<std::uint8_t>((cell_[i] & ~unsure_[i]) | (fallen & unsure_[i]));
    }
  }
  bool dark() const { return dark_; }
  /// The next `writes` program() calls report an error and clear only some of their bits.
  void refuse(std::uint32_t writes) { refusals_ = writes; }
  /// Flips bits, as ageing does.
  void damage(std::size_t page, std::size_t offset, std::uint8_t mask) {
    std::uint8_t& cell = cell_[page * kPageBytes + offset];
    cell = static_cast<std::uint8_t>(cell ^ mask);
  }
  std::uint32_t programs() const { return programs_; }
  std::uint32_t erases() const { return erases_; }
  /// Calls past a page's end, or not at a multiple of the unit.
  std::uint32_t misuses() const { return misuses_; }

  // FlashPages
  std::size_t page_bytes(std::size_t) const { return kPageBytes; }

  const std::uint8_t* memory(std::size_t page) const { return cell_ + page * kPageBytes; }

  void read(std::size_t page, std::size_t offset, std::uint8_t* to, std::size_t size) const {
    if (page > 1 || offset + size > kPageBytes) {
      ++misuses_;
      return;
    }
    for (std::size_t i = 0; i < size; ++i) to[i] = cell_[page * kPageBytes + offset + i];
  }

  bool program(std::size_t page, std::size_t offset, const std::uint8_t* from) {
    if (page > 1 || offset % kUnit != 0 || offset + kUnit > kPageBytes) ++misuses_;
    if (dark_ || page > 1 || offset + kUnit > kPageBytes) return false;
    ++programs_;
    const bool cut = cut_here();
    const bool refused = refusals_ > 0;
    if (refused) --refusals_;
    for (std::size_t i = 0; i < kUnit; ++i) {
      std::uint8_t& cell = cell_[page * kPageBytes + offset + i];
      std::uint8_t& unsure = unsure_[page * kPageBytes + offset + i];
      const auto zeros = static_cast<std::uint8_t>(~from[i]);
      if (cut) {
        unsure = static_cast<std::uint8_t>(unsure | (cell & zeros));
      } else {
        const auto cleared = static_cast<std::uint8_t>(refused ? zeros & random() : zeros);
        cell = static_cast<std::uint8_t>(cell & ~cleared);
        unsure = static_cast<std::uint8_t>(unsure & ~cleared);
      }
    }
    return !cut && !refused;
  }

  bool erase(std::size_t page) {
    if (page > 1) ++misuses_;
    if (dark_ || page > 1) return false;
    ++erases_;
    const bool cut = cut_here();
    for (std::size_t i = page * kPageBytes; i < (page + 1) * kPageBytes; ++i) {
      if (!cut) cell_[i] = 0xFF;
      unsure_[i] = cut ? 0xFF : 0;
    }
    return !cut;
  }

 private:
  bool cut_here() {
    if (!cut_planned_ || writes_left_-- > 0) return false;
    dark_ = true;
    return true;
  }
  std::uint32_t random() {  // xorshift32 (Marsaglia 2003)
    random_ ^= random_ << 13;
    random_ ^= random_ >> 17;
    random_ ^= random_ << 5;
    return random_ >> 8;
  }

  std::uint32_t random_;
  std::uint32_t writes_left_ = 0;
  std::uint32_t refusals_ = 0;
  std::uint32_t programs_ = 0;
  std::uint32_t erases_ = 0;
  mutable std::uint32_t misuses_ = 0;
  bool cut_planned_ = false;
  bool dark_ = false;
  alignas(8) std::uint8_t cell_[2 * kPageBytes];
  std::uint8_t unsure_[2 * kPageBytes] = {};
};

static_assert(FlashPages<FakeFlash<1024, 4>>);

}  // namespace verp::hal
