#include <gtest/gtest.h>

#include "firmware/app/lockstep_messages.hpp"

namespace verp {
namespace {

using lockstep::ClockSieve;

constexpr std::size_t kRoom = 4096;

struct Stream {
  void put(std::uint8_t byte) { bytes[size++] = byte; }
  void put_packet(std::uint8_t id, std::uint32_t mark) {
    std::uint8_t data[4];
    dxl::put_u32(data, mark);
    size += dxl::encode_write(bytes + size, sizeof bytes - size, id, 96, data, sizeof data);
  }
  void run() {
    ClockSieve sieve;
    for (std::size_t i = 0; i < size; ++i) {
      const bool found =
          sieve.push(bytes[i], [this](std::uint8_t byte) { passed[count++] = byte; });
      if (found) marks[packets++] = dxl::get_u32(sieve.packet().parameters + 2);
    }
  }
  std::uint8_t bytes[kRoom] = {};
  std::uint8_t passed[kRoom] = {};
  std::uint32_t marks[64] = {};
  std::size_t size = 0, count = 0;
  int packets = 0;
};

struct Dice {
  std::uint32_t operator()() {
    state = state * 1664525u + 1013904223u;
    return state >> 8;
  }
  std::uint32_t state;
};

TEST(ClockSieve, TakesThePacketsOfTheClockAndPassesTheRest) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    Dice dice{seed};
    static Stream mixed, plain;
    mixed.size = mixed.count = plain.size = 0;
    mixed.packets = 0;
    for (std::uint32_t i = 0; i < 40; ++i) {
      const std::uint32_t mark = dice() << 8 | 0xFD;
      mixed.put_packet(lockstep::kClockId, i % 3 == 0 ? 0xFFFDFFFFu : mark);
      mixed.put_packet(static_cast<std::uint8_t>(dice() % 200), mark);
    }
    Dice again{seed};
    for (std::uint32_t i = 0; i < 40; ++i) {
      const std::uint32_t mark = again() << 8 | 0xFD;
      plain.put_packet(static_cast<std::uint8_t>(again() % 200), mark);
    }
    mixed.run();
    EXPECT_EQ(mixed.packets, 40);
    ASSERT_EQ(mixed.count, plain.size);
    for (std::size_t i = 0; i < plain.size; ++i) ASSERT_EQ(mixed.passed[i], plain.bytes[i]);
    for (int i = 0; i < 40; i += 3) ASSERT_EQ(mixed.marks[i], 0xFFFDFFFFu);
  }
}

TEST(ClockSieve, FindsAWholePacketBehindAnyDamage) {
  for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
    Dice dice{seed};
    static Stream stream;
    stream.size = stream.count = 0;
    stream.packets = 0;
    stream.put_packet(dice() % 2 == 0 ? lockstep::kClockId : std::uint8_t{1}, 0);
    const std::size_t cut = dice() % stream.size;
    stream.bytes[cut] = static_cast<std::uint8_t>(dice());
    stream.size = cut + 1 + dice() % (stream.size - cut);
    const std::size_t damaged = stream.size;
    stream.put_packet(lockstep::kClockId, seed);
    stream.run();
    ASSERT_GE(stream.packets, 1) << seed;
    EXPECT_EQ(stream.marks[stream.packets - 1], seed);
    if (stream.packets == 1) {
      ASSERT_EQ(stream.count, damaged);
      for (std::size_t i = 0; i < damaged; ++i) ASSERT_EQ(stream.passed[i], stream.bytes[i]);
    }
  }
}

}  // namespace
}  // namespace verp
