#include "firmware/store/program_bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hal/fake/fake_flash.hpp"

namespace verp {
namespace {

using Flash = hal::FakeFlash<512, 8>;
constexpr std::size_t kSize = 203;  ///< ends within a unit
constexpr std::size_t kAt = 13;
constexpr std::uint32_t kUnits = 26;

struct Nothing {
  void operator()() const {}
};

struct Bytes {
  Bytes() {
    for (std::size_t i = 0; i < kSize; ++i) byte[i] = static_cast<std::uint8_t>(7 * i + 3);
  }
  bool are_in(const Flash& flash) const {
    return __builtin_memcmp(flash.memory(1) + kAt, byte, kSize) == 0;
  }
  std::uint8_t byte[kSize];
};

TEST(ProgramBytes, ArePutWhereTheyBelongAndNothingElseIsTouched) {
  Flash flash;
  const Bytes bytes;
  EXPECT_TRUE(store::program_bytes(flash, 1, kAt, bytes.byte, kSize, Nothing{}));
  EXPECT_TRUE(bytes.are_in(flash));
  for (std::size_t i = 0; i < 512; ++i) {
    EXPECT_EQ(flash.memory(0)[i], 0xFF);
    const bool is_ours = i >= kAt && i < kAt + kSize;
    EXPECT_TRUE(is_ours || flash.memory(1)[i] == 0xFF) << i;
  }
  EXPECT_EQ(flash.misuses(), 0u);
}

// CAN delivers seven bytes, some twice.
TEST(ProgramBytes, MayComeInPiecesOfAnySizeAndOrderAndAgain) {
  for (const std::size_t piece : {1u, 7u, 13u, 100u}) {
    Flash flash;
    const Bytes bytes;
    for (int times = 0; times < 2; ++times) {
      for (std::size_t end = kSize; end > 0;) {
        const std::size_t count = end < piece ? end : piece;
        end -= count;
        ASSERT_TRUE(store::program_bytes(flash, 1, kAt + end, bytes.byte + end, count, Nothing{}));
      }
    }
    EXPECT_TRUE(bytes.are_in(flash)) << piece;
    EXPECT_EQ(flash.misuses(), 0u);
  }
}

TEST(ProgramBytes, NeverClaimWhatTheMemoryDidNotTake) {
  const Bytes bytes;
  Flash refusing;
  refusing.refuse(3);
  EXPECT_FALSE(store::program_bytes(refusing, 1, kAt, bytes.byte, kSize, Nothing{}));
  Flash used;
  const std::uint8_t zeros[8] = {};
  ASSERT_TRUE(store::program_bytes(used, 1, kAt + 100, zeros, 8, Nothing{}));
  EXPECT_FALSE(store::program_bytes(used, 1, kAt, bytes.byte, kSize, Nothing{}));
  for (std::uint32_t writes = 0; writes < kUnits; ++writes) {
    Flash cut(writes + 1);
    cut.cut_after(writes);
    EXPECT_FALSE(store::program_bytes(cut, 1, kAt, bytes.byte, kSize, Nothing{})) << writes;
  }
  Flash whole;
  whole.cut_after(kUnits);
  EXPECT_TRUE(store::program_bytes(whole, 1, kAt, bytes.byte, kSize, Nothing{}));
}

TEST(ProgramBytes, BeyondThePageAreRefusedWhole) {
  Flash flash;
  const std::uint8_t zeros[16] = {};
  EXPECT_FALSE(store::program_bytes(flash, 1, 512 - 8, zeros, 16, Nothing{}));
  EXPECT_FALSE(store::program_bytes(flash, 1, 513, zeros, 1, Nothing{}));
  EXPECT_EQ(flash.programs(), 0u);
  EXPECT_EQ(flash.misuses(), 0u);
}

}  // namespace
}  // namespace verp
