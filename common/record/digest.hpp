#pragma once
#include <bit>
#include <cstdint>

#include "common/base/fields.hpp"

/// Digests, not cryptographic: do two runs have the same bits?
namespace verp::record {

static_assert(std::endian::native == std::endian::little, "byte images are little-endian");

/// Rotate, xor, multiply, four instructions a word on a Cortex-M. In a word-wise FNV two sign bits
/// could cancel.
class Digest32 {
 public:
  constexpr explicit Digest32(std::uint32_t seed) : value_(seed) {}
  constexpr void add(std::uint32_t word) { value_ = (std::rotl(value_, 5) ^ word) * 0x9E3779B1u; }

  template <class T>
  void add_struct(const T& data) {
    static_assert(packed_size<T>() == sizeof(T) && sizeof(T) % 4 == 0);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&data);
    const auto word = [bytes](std::size_t at) {
      std::uint32_t loaded;
      __builtin_memcpy(&loaded, bytes + at, 4);
      return loaded;
    };
    std::size_t at = 0;
    for (; at + 16 <= sizeof(T); at += 16) {  // unrolled: a third faster
      add(word(at));
      add(word(at + 4));
      add(word(at + 8));
      add(word(at + 12));
    }
    for (; at < sizeof(T); at += 4) add(word(at));
  }
  constexpr std::uint32_t value() const { return value_ ^ (value_ >> 15); }

 private:
  std::uint32_t value_;
};

/// One link of the 64-bit chain. A run's last value identifies all earlier words.
constexpr std::uint64_t chain(std::uint64_t previous, std::uint32_t word) {
  std::uint64_t mixed = (previous ^ word) * 0x9E3779B97F4A7C15ull;
  return mixed ^ (mixed >> 29);
}

inline constexpr std::uint64_t kChainSeed = 0x7665'7270'2d30'3031ull;  // "verp-001"

}  // namespace verp::record
