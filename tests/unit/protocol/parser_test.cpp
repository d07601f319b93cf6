#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"

// Compares the parser with a reference that sees the whole stream.

namespace verp::dxl {
namespace {

constexpr std::size_t kStream = 1500;

struct Random {
  std::uint32_t state = 88172645u;
  std::uint32_t next() {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
  }
  std::uint32_t below(std::uint32_t count) { return (next() >> 8) % count; }
};

struct Stream {
  std::uint8_t bytes[kStream];
  std::size_t size = 0;
  void add(std::uint32_t byte) {
    if (size < kStream) bytes[size++] = static_cast<std::uint8_t>(byte);
  }
  void add_header(std::uint32_t length) {
    constexpr std::uint8_t kMark[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01};
    for (const std::uint8_t byte : kMark) add(byte);
    add(length);
    add(length >> 8);
  }
};

void add_packet(Stream& stream, Random& random, bool spoilt) {
  std::uint8_t packet[kMaxPacket];
  std::uint8_t data[64];
  const std::size_t count = random.below(sizeof data);
  for (std::size_t i = 0; i < count; ++i) {
    data[i] = static_cast<std::uint8_t>(random.below(3) == 0 ? random.next() : 0xFD + i % 3);
  }
  const std::size_t size = encode_status(packet, sizeof packet, 1, 0, data, count);
  if (spoilt) packet[random.below(static_cast<std::uint32_t>(size))] ^= 1;
  for (std::size_t i = 0; i < size; ++i) stream.add(packet[i]);
}

void fill(Stream& stream, Random& random) {
  stream.size = 0;
  while (stream.size < kStream) {
    switch (random.below(6)) {
      case 0:
      case 1:
        add_packet(stream, random, false);
        break;
      case 2:
        add_packet(stream, random, true);
        break;
      case 3:
        stream.add_header(random.below(700));
        break;
      case 4:
        for (std::uint32_t i = random.below(60); i > 0; --i) stream.add(random.next() >> 16);
        break;
      default:
        for (std::uint32_t i = random.below(12); i > 0; --i) stream.add(0xFF - 2 * random.below(2));
    }
  }
}

struct Reference {
  std::size_t at = 0;     ///< search position
  std::size_t known = 0;  ///< bytes the parser needs
  std::uint32_t crc_errors = 0, noise = 0;

  bool next(const Stream& stream, std::size_t& start, std::size_t& end) {
    for (;; ++at, ++noise) {
      const std::uint8_t* from = stream.bytes + at;
      const std::size_t left = stream.size - at;
      constexpr std::uint8_t kMark[4] = {0xFF, 0xFF, 0xFD, 0x00};
      std::size_t same = 0;
      while (same < 4 && same < left && from[same] == kMark[same]) ++same;
      if (same < 4 && same < left) continue;
      if (left < kHeaderBytes) return false;
      const std::size_t size = kHeaderBytes + get_u16(from + 5);
      if (size < kInstructionBytes || size > kMaxPacket) continue;
      if (size > left) return false;
      known = known > at + size ? known : at + size;
      if (crc16(from, size - 2) == get_u16(from + size - 2)) {
        start = at;
        end = at += size;
        return true;
      }
      ++crc_errors;
    }
  }
};

TEST(Parser, FindsWhatIsThereAsSoonAsItCanBeKnown) {
  static Stream stream;
  Random random;
  int packets = 0;
  for (int run = 0; run < 60; ++run) {
    fill(stream, random);
    Reference reference;
    Parser parser;
    std::size_t pushed = 0, start = 0, end = 0;
    while (reference.next(stream, start, end)) {
      bool found = pushed > 0 && parser.next();
      while (!found && pushed < reference.known) found = parser.push(stream.bytes[pushed++]);
      ASSERT_TRUE(found) << "run " << run << ", the packet at byte " << start;
      ASSERT_EQ(pushed, reference.known) << "run " << run << ", the packet at byte " << start;
      ASSERT_EQ(parser.packet().id, stream.bytes[start + 4]);
      ASSERT_EQ(parser.crc_errors(), reference.crc_errors) << "run " << run;
      ASSERT_EQ(parser.noise_bytes(), reference.noise) << "run " << run;
      ++packets;
    }
    while (pushed < stream.size) ASSERT_FALSE(parser.next() || parser.push(stream.bytes[pushed++]));
    ASSERT_EQ(parser.crc_errors(), reference.crc_errors) << "run " << run;
    ASSERT_EQ(parser.noise_bytes(), reference.noise) << "run " << run;
  }
  EXPECT_GT(packets, 500);
}

std::uint32_t steps_of(Parser& parser, const std::uint8_t* bytes, std::size_t size) {
  const std::uint32_t before = parser.steps();
  for (std::size_t i = 0; i < size; ++i) {
    for (bool found = parser.push(bytes[i]); found; found = parser.next()) {
    }
  }
  return parser.steps() - before;
}

// A long false packet, then noise: the worst line of a real robot.
TEST(Parser, PaysAFewStepsForEachByteOfNoise) {
  static Stream stream;
  Random random;
  constexpr std::uint32_t kAnnounced[] = {0x1F0, 0x100, 0x40};
  for (const std::uint32_t announced : kAnnounced) {
    stream.size = 0;
    stream.add_header(announced);
    while (stream.size < kStream) stream.add(random.below(4) == 0 ? 0xFF : random.next() >> 16);
    Parser parser;
    EXPECT_LT(steps_of(parser, stream.bytes, stream.size), 4 * kStream) << announced;
  }
}

// Headers are at least seven bytes apart; each costs at most one sum and one move of the rest.
TEST(Parser, HasABoundForTheWorstOfStreams) {
  static Stream stream;
  constexpr std::uint32_t kMost = 2 + 2 * (kMaxPacket / kHeaderBytes + 1);
  std::uint32_t worst = 0;
  for (std::uint32_t step = 0; step < 3; ++step) {
    stream.size = 0;
    for (std::uint32_t k = 0; stream.size < kStream; ++k) {
      // All end at the same byte, one by one, or far away.
      const std::uint32_t length = step == 2 ? 505 : 498 - (step == 0 ? 7 * (k % 71) : k % 71);
      stream.add_header(length);
    }
    Parser parser;
    const std::uint32_t steps = steps_of(parser, stream.bytes, stream.size);
    EXPECT_LT(steps, kMost * kStream) << step;
    worst = steps > worst ? steps : worst;
  }
  EXPECT_GT(worst, 10 * kStream) << "these streams are not what the bound is for";
}

}  // namespace
}  // namespace verp::dxl
