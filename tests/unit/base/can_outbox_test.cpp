#include "common/base/can_outbox.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "common/base/can_frame.hpp"

namespace verp {
namespace {

CanFrame with_id(std::uint32_t id, bool extended = false, bool remote = false) {
  CanFrame frame;
  frame.id = id;
  frame.extended = extended;
  frame.remote = remote;
  return frame;
}

std::uint32_t next(std::uint32_t& seed) {
  seed = seed * 1664525u + 1013904223u;
  return seed >> 8;
}

/// The arbitration field bit by bit (ISO 11898-1).
bool wins(const CanFrame& a, const CanFrame& b) {
  const auto bit = [](const CanFrame& frame, unsigned at) -> unsigned {
    const std::uint32_t base = frame.extended ? frame.id >> 18 : frame.id;
    if (at < 11) return base >> (10 - at) & 1u;
    if (at == 11) return frame.extended || frame.remote ? 1u : 0u;  // SRR, RTR
    if (at == 12) return frame.extended ? 1u : 0u;                  // IDE
    if (!frame.extended) return 0u;
    return at < 31 ? frame.id >> (30 - at) & 1u : (frame.remote ? 1u : 0u);
  };
  for (unsigned at = 0; at < 32; ++at) {
    if (bit(a, at) != bit(b, at)) return bit(a, at) < bit(b, at);
  }
  return false;
}

TEST(CanRank, IsTheOrderOfTheWire) {
  std::uint32_t seed = 1;
  for (int i = 0; i < 20'000; ++i) {
    CanFrame pair[2];
    for (CanFrame& frame : pair) {
      const std::uint32_t kind = next(seed);
      frame = with_id(0, (kind & 1u) != 0, (kind & 2u) != 0);
      // The first eleven bits often match.
      frame.id = frame.extended ? (next(seed) & 3u) << 18 | (next(seed) & 3u) : next(seed) & 3u;
    }
    ASSERT_EQ(can_rank(pair[0]) < can_rank(pair[1]), wins(pair[0], pair[1])) << pair[0].id;
  }
}

TEST(CanFrame, SaysWhatThereCannotBe) {
  EXPECT_TRUE(is_sound(with_id(0x7FF)));
  EXPECT_FALSE(is_sound(with_id(0x800)));
  EXPECT_TRUE(is_sound(with_id(0x1FFFFFFF, true)));
  EXPECT_FALSE(is_sound(with_id(0x20000000, true)));
  for (unsigned size = 0; size <= 80; ++size) {
    CanFrame frame = with_id(1);
    frame.size = static_cast<std::uint8_t>(size);
    EXPECT_EQ(is_sound(frame), size <= 8) << size;
    frame.fd = true;
    EXPECT_EQ(is_sound(frame), size <= 8 || size == 12 || size == 16 || size == 20 || size == 24 ||
                                   size == 32 || size == 48 || size == 64)
        << size;
    frame.remote = true;
    EXPECT_FALSE(is_sound(frame)) << "FD has no remote frames";
  }
  CanFrame fast = with_id(1);
  fast.bit_rate_switch = true;
  EXPECT_FALSE(is_sound(fast)) << "only FD changes its rate";
}

TEST(CanOutbox, GivesTheBestAndKeepsTheOrderOfEquals) {
  std::uint32_t seed = 7;
  CanOutbox<16> box;
  bool inside[4096] = {};
  std::uint32_t pushed = 0;
  std::uint32_t popped = 0;
  std::uint32_t last_of[8] = {};
  while (popped < 4000) {
    if ((next(seed) & 1u) != 0 && pushed < 4000) {
      CanFrame frame = with_id(next(seed) & 7u);
      frame.size = 2;
      frame.data[0] = static_cast<std::uint8_t>(pushed);
      frame.data[1] = static_cast<std::uint8_t>(pushed >> 8);
      const bool room = box.size() < 16;
      ASSERT_EQ(box.push(frame), room);
      if (room) inside[pushed++] = true;
    } else if (!box.empty()) {
      const CanFrame best = box.best();
      const std::uint32_t number = best.data[0] | std::uint32_t{best.data[1]} << 8;
      box.pop();
      ASSERT_TRUE(inside[number]);
      inside[number] = false;
      ASSERT_TRUE(number >= last_of[best.id]) << "an older frame of the same identifier waited";
      last_of[best.id] = number;
      if (!box.empty()) {
        ASSERT_LE(best.id, box.best().id);
      }
      ++popped;
    }
    ASSERT_EQ(box.size(), pushed - popped);
  }
  EXPECT_TRUE(box.empty());
}

}  // namespace
}  // namespace verp
