#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "hal/contract/frame_bus.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/frame_bus.hpp.

namespace verp {
namespace {

using test::kPing;
using test::ping_reply;

constexpr std::uint32_t kTooShort_us = 60;  // shorter than a ping, or the script's delay

template <class Backend>
class FrameBusContract : public ::testing::Test {
 protected:
  static bool ping(Backend& backend) { return backend.bus.send(kPing.data(), kPing.size()); }
  static std::vector<std::uint8_t> collect(Backend& backend, std::size_t capacity,
                                           std::uint32_t timeout_us) {
    std::vector<std::uint8_t> all;
    std::vector<std::uint8_t> piece(capacity);
    while (const std::size_t count = backend.bus.poll(piece.data(), capacity, timeout_us)) {
      EXPECT_LE(count, capacity);
      all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(count));
    }
    return all;
  }
};

TYPED_TEST_SUITE(FrameBusContract, test::FrameBuses);

TYPED_TEST(FrameBusContract, ImplementsTheInterface) {
  static_assert(
      std::derived_from<std::remove_reference_t<decltype(TypeParam::bus)>, hal::FrameBus>);
}

TYPED_TEST(FrameBusContract, RefusesEmptyAndOversizedFrames) {
  TypeParam backend(0);
  const std::vector<std::uint8_t> large(hal::kMaxFrame + 1);
  EXPECT_FALSE(backend.bus.send(kPing.data(), 0));
  EXPECT_FALSE(backend.bus.send(large.data(), large.size()));
  EXPECT_TRUE(this->collect(backend, 64, TypeParam::kPlenty_us).empty());
}

TYPED_TEST(FrameBusContract, BringsTheReplyWholeAndInOrder) {
  TypeParam backend(2);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(this->ping(backend));
    EXPECT_EQ(this->collect(backend, 256, TypeParam::kPlenty_us), ping_reply());
  }
}

TYPED_TEST(FrameBusContract, KeepsBytesThatDidNotFit) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  EXPECT_EQ(this->collect(backend, 1, TypeParam::kPlenty_us), ping_reply());
}

TYPED_TEST(FrameBusContract, ReturnsNothingOnlyWhenTheTimeIsOver) {
  TypeParam backend(0);
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(backend.bus.poll(buffer.data(), buffer.size(), 1000), 0u);
  EXPECT_GE(backend.bus.now_us(), 1000u);
}

TYPED_TEST(FrameBusContract, CountsTheTimeoutFromTheSendNotFromThePoll) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  EXPECT_EQ(this->collect(backend, 256, TypeParam::kPlenty_us), ping_reply());
  const std::uint64_t after_us = backend.bus.now_us();
  std::array<std::uint8_t, 16> buffer{};
  EXPECT_EQ(backend.bus.poll(buffer.data(), buffer.size(), TypeParam::kPlenty_us), 0u);
  EXPECT_LE(backend.bus.now_us(), after_us + TypeParam::kSlack_us);
}

TYPED_TEST(FrameBusContract, DeliversALateReplyToALaterPoll) {
  TypeParam backend(1);
  ASSERT_TRUE(this->ping(backend));
  std::vector<std::uint8_t> all = this->collect(backend, 256, kTooShort_us);
  EXPECT_TRUE(all.empty() || TypeParam::kSlack_us > 0);  // in real time the PC may be late
  const std::vector<std::uint8_t> late = this->collect(backend, 256, TypeParam::kPlenty_us);
  all.insert(all.end(), late.begin(), late.end());
  EXPECT_EQ(all, ping_reply());
}

TYPED_TEST(FrameBusContract, NeverTurnsTimeBack) {
  TypeParam backend(4);
  std::uint64_t last_us = backend.bus.now_us();
  const std::uint32_t timeouts_us[] = {0, 500, 100, TypeParam::kPlenty_us};
  for (const std::uint32_t timeout_us : timeouts_us) {
    ASSERT_TRUE(this->ping(backend));
    this->collect(backend, 5, timeout_us);
    EXPECT_GE(backend.bus.now_us(), last_us);
    last_us = backend.bus.now_us();
  }
}

TEST(ScriptedBus, NamesWhatDidNotFollowTheScript) {
  hal::ScriptedBus bus;
  ASSERT_TRUE(bus.expect(kPing.data(), kPing.size(), nullptr, 0, 0));
  EXPECT_FALSE(bus.finished());
  bus.send(kPing.data(), kPing.size() - 1);
  EXPECT_EQ(bus.mismatches(), 1u);
  bus.send(kPing.data(), kPing.size());
  EXPECT_FALSE(bus.finished());
}

}  // namespace
}  // namespace verp
