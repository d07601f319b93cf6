#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "hal/contract/byte_link.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/byte_link.hpp, each end of each link.

namespace verp {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::uint32_t kAWhile_us = 5'000'000;
constexpr std::uint64_t kAtOnce_us = 1'000'000;  // a busy PC may be slow; a timeout is longer

Bytes random_bytes(std::size_t size, std::mt19937& random) {
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

/// An endless noise stream, which a target cannot store.
std::uint8_t noise(std::size_t place, std::uint32_t stream) {
  auto bits = static_cast<std::uint32_t>(place) * 2654435761u + stream;
  bits ^= bits >> 15;
  bits *= 2246822519u;
  return static_cast<std::uint8_t>(bits >> 13);
}

template <class Pair>
class ByteLinkContract : public ::testing::Test {
 protected:
  /// Stops when no byte comes for a while.
  template <class Link>
  static Bytes collect(Link& link, std::size_t size) {
    Bytes all(size);
    std::size_t have = 0;
    while (have < size) {
      const std::size_t count = link.read(all.data() + have, size - have, kAWhile_us);
      if (count == 0) break;
      have += count;
    }
    all.resize(have);
    return all;
  }
  template <class Link>
  static Bytes fill(Link& link, std::mt19937& random) {
    Bytes all;
    for (;;) {
      const Bytes part = random_bytes(4096, random);
      const std::size_t count = link.write(part.data(), part.size(), 0);
      all.insert(all.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
      if (count < part.size()) return all;
    }
  }
  bool meet() {
    std::uint8_t byte = 0;
    for (int i = 0; i < 500; ++i) {
      pair.near().write(&byte, 0, 1000);
      if (pair.near().connected() && pair.far().connected()) return true;
      pair.near().read(&byte, 1, 5000);
      pair.far().read(&byte, 1, 5000);
    }
    return false;
  }
  Bytes drain_until_lost() {
    Bytes all;
    std::uint8_t piece[64];
    for (int i = 0; i < 500 && pair.near().connected(); ++i) {
      const std::size_t count = pair.near().read(piece, sizeof piece, 10'000);
      all.insert(all.end(), piece, piece + count);
    }
    return all;
  }

  void expect_lost(std::uint32_t times) {
    EXPECT_EQ(pair.near().connected(), !Pair::kDetectsLoss);
    EXPECT_EQ(pair.near().errors().losses, Pair::kDetectsLoss ? times : 0u);
  }

  Pair pair;
  std::mt19937 random{5};
};

TYPED_TEST_SUITE(ByteLinkContract, test::ByteLinks);

TYPED_TEST(ByteLinkContract, BeginsConnectedAndWithoutErrors) {
  EXPECT_TRUE(this->pair.near().connected());
  EXPECT_TRUE(this->pair.far().connected());
  const hal::LinkErrors errors = this->pair.near().errors();
  EXPECT_EQ(errors.overruns + errors.framing + errors.noise + errors.losses, 0u);
}

TYPED_TEST(ByteLinkContract, CarriesAnyBytesInOrderBothWays) {
  constexpr std::size_t kBytes = 20'000;
  struct Way {
    std::uint32_t stream;
    std::size_t sent = 0;
    std::size_t found = 0;
  };
  Way there{1};
  Way back{2};
  const auto write = [this](auto& link, Way& way) {
    std::uint8_t piece[300];
    const std::size_t size =
        std::min<std::size_t>(this->random() % sizeof piece, kBytes - way.sent);
    for (std::size_t i = 0; i < size; ++i) piece[i] = noise(way.sent + i, way.stream);
    way.sent += link.write(piece, size, 0);
  };
  const auto read = [this](auto& link, Way& way) {
    std::uint8_t piece[300];
    const std::size_t capacity = 1 + this->random() % sizeof piece;
    const std::size_t count = link.read(piece, capacity, 100);
    ASSERT_LE(count, capacity);
    for (std::size_t i = 0; i < count; ++i, ++way.found) {
      ASSERT_EQ(piece[i], noise(way.found, way.stream)) << "byte " << way.found;
    }
  };
  for (int i = 0; i < 20'000 && there.found + back.found < 2 * kBytes; ++i) {
    write(this->pair.near(), there);
    write(this->pair.far(), back);
    read(this->pair.far(), there);
    read(this->pair.near(), back);
  }
  EXPECT_EQ(there.found, kBytes);
  EXPECT_EQ(back.found, kBytes);
}

TYPED_TEST(ByteLinkContract, WaitsForItsTimeoutAndNotWithoutOne) {
  std::uint8_t byte = 0;
  const std::uint64_t before_us = this->pair.now_us();
  EXPECT_EQ(this->pair.near().read(&byte, 1, 0), 0u);
  const std::uint64_t between_us = this->pair.now_us();
  EXPECT_EQ(this->pair.near().read(&byte, 1, 3000), 0u);
  const std::uint64_t after_us = this->pair.now_us();
  EXPECT_LE(between_us, before_us + kAtOnce_us);
  EXPECT_GE(after_us, between_us + 3000);
  EXPECT_LE(after_us, between_us + 3000 + kAtOnce_us);
}

TYPED_TEST(ByteLinkContract, ReturnsAsSoonAsThereIsAByte) {
  const std::uint8_t sent = 42;
  std::uint8_t buffer[100] = {};
  ASSERT_EQ(this->pair.far().write(&sent, 1, kAWhile_us), 1u);
  const std::uint64_t before_us = this->pair.now_us();
  EXPECT_EQ(this->pair.near().read(buffer, sizeof buffer, kAWhile_us), 1u);
  EXPECT_EQ(buffer[0], sent);
  EXPECT_LE(this->pair.now_us(), before_us + kAtOnce_us);
}

TYPED_TEST(ByteLinkContract, TakesWhatFitsAndNoByteTwice) {
  const Bytes sent = this->fill(this->pair.near(), this->random);
  EXPECT_GT(sent.size(), 0u);
  const std::uint64_t before_us = this->pair.now_us();
  const Bytes more(4096);
  std::size_t taken = 0;
  std::size_t last = more.size();
  while (last == more.size()) {
    taken += last = this->pair.near().write(more.data(), more.size(), 2000);
  }
  EXPECT_GE(this->pair.now_us(), before_us + 2000);
  EXPECT_TRUE(this->collect(this->pair.far(), sent.size()) == sent);
  EXPECT_EQ(this->collect(this->pair.far(), taken).size(), taken);
  EXPECT_EQ(this->pair.near().write(more.data(), 100, kAWhile_us), 100u);
  EXPECT_EQ(this->collect(this->pair.far(), 100).size(), 100u);
}

TYPED_TEST(ByteLinkContract, TellsALossAfterWhatCameBefore) {
  const Bytes last = random_bytes(50, this->random);
  ASSERT_EQ(this->pair.far().write(last.data(), last.size(), kAWhile_us), last.size());
  this->pair.cut();
  const Bytes found = this->drain_until_lost();
  EXPECT_TRUE(found == last || !TypeParam::kKeepsBytesOnLoss);
  this->expect_lost(1);
}

TYPED_TEST(ByteLinkContract, OutlivesALoss) {
  this->pair.cut();
  const Bytes bytes(100);
  std::uint8_t byte = 0;
  for (int i = 0; i < 20; ++i) {
    this->pair.near().write(bytes.data(), bytes.size(), 500);
    this->pair.near().read(&byte, 1, 500);
  }
  this->expect_lost(1);
  const std::uint64_t before_us = this->pair.now_us();
  EXPECT_EQ(this->pair.near().read(&byte, 1, 2000), 0u);
  const bool takes_it = !TypeParam::kDetectsLoss;  // a wire takes bytes that no end hears
  EXPECT_EQ(this->pair.near().write(&byte, 1, 2000), takes_it ? 1u : 0u);
  EXPECT_GE(this->pair.now_us(), before_us + (takes_it ? 2000 : 4000));
}

TYPED_TEST(ByteLinkContract, FindsTheOtherEndAgain) {
  for (std::uint32_t round = 1; round <= 3; ++round) {
    this->pair.cut();
    this->drain_until_lost();
    this->expect_lost(round);
    this->pair.mend();
    ASSERT_TRUE(this->meet());
    const Bytes there = random_bytes(100, this->random);
    const Bytes back = random_bytes(100, this->random);
    ASSERT_EQ(this->pair.near().write(there.data(), there.size(), kAWhile_us), there.size());
    ASSERT_EQ(this->pair.far().write(back.data(), back.size(), kAWhile_us), back.size());
    EXPECT_EQ(this->collect(this->pair.far(), there.size()), there);
    EXPECT_EQ(this->collect(this->pair.near(), back.size()), back);
  }
}

TEST(MemoryWire, CountsWhatTheTestSpoils) {
  hal::MemoryWire wire;
  hal::MemoryWire::spoil_framing(wire.left());
  hal::MemoryWire::spoil_noise(wire.left());
  EXPECT_EQ(wire.left().errors().framing, 1u);
  EXPECT_EQ(wire.left().errors().noise, 1u);
  EXPECT_EQ(wire.right().errors().framing, 0u);
}

}  // namespace
}  // namespace verp
