#include "firmware/store/program_page.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hal/fake/fake_flash.hpp"

namespace verp {
namespace {

using Flash = hal::FakeFlash<512, 8>;
constexpr std::size_t kSize = 203;  // ends within a unit

struct Nothing {
  void operator()() const {}
};

struct Bytes {
  explicit Bytes(std::uint8_t first) {
    for (std::size_t i = 0; i < kSize; ++i) byte[i] = static_cast<std::uint8_t>(first + 7 * i);
  }
  bool are_in(const Flash& flash, std::size_t page) const {
    std::uint8_t there[kSize];
    flash.read(page, 0, there, kSize);
    return __builtin_memcmp(there, byte, kSize) == 0;
  }
  std::uint8_t byte[kSize];
};

TEST(ProgramPage, ReplacesWhatWasThereAndLeavesTheOtherPageAlone) {
  Flash flash;
  const Bytes old(1), other(2), fresh(3);
  ASSERT_TRUE(store::program_page(flash, 0, old.byte, kSize, Nothing{}));
  ASSERT_TRUE(store::program_page(flash, 1, other.byte, kSize, Nothing{}));
  EXPECT_TRUE(store::program_page(flash, 0, fresh.byte, kSize, Nothing{}));
  EXPECT_TRUE(fresh.are_in(flash, 0));
  EXPECT_TRUE(other.are_in(flash, 1));
  EXPECT_EQ(flash.misuses(), 0u);
}

TEST(ProgramPage, NeverClaimsWhatTheMemoryDidNotTake) {
  const Bytes bytes(9);
  Flash refusing;
  refusing.refuse(3);
  EXPECT_FALSE(store::program_page(refusing, 0, bytes.byte, kSize, Nothing{}));
  for (std::uint32_t writes = 0; writes < 27; ++writes) {  // an erase and 26 units
    Flash cut(writes + 1);
    cut.cut_after(writes);
    EXPECT_FALSE(store::program_page(cut, 0, bytes.byte, kSize, Nothing{})) << writes;
  }
  Flash whole;
  whole.cut_after(27);
  EXPECT_TRUE(store::program_page(whole, 0, bytes.byte, kSize, Nothing{}));
}

TEST(ProgramPage, RefusesMoreThanAPageHoldsAndErasesNothing) {
  Flash flash;
  const Bytes bytes(5);
  ASSERT_TRUE(store::program_page(flash, 0, bytes.byte, kSize, Nothing{}));
  static const std::uint8_t much[513] = {};
  EXPECT_FALSE(store::program_page(flash, 0, much, sizeof much, Nothing{}));
  EXPECT_TRUE(bytes.are_in(flash, 0));
}

}  // namespace
}  // namespace verp
