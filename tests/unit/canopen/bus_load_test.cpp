#include "common/protocol/canopen/bus_load.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/cob_id.hpp"
#include "tests/unit/canopen/sdo_bench.hpp"

namespace verp::canopen {
namespace {

// From the literature: 47 + 8 n bits for 11-bit identifiers, at worst (34 + 8 n - 1) / 4 more; 67
// and 54 for 29 bits.
TEST(BusLoad, ClassicFramesHaveTheKnownLengths) {
  for (std::uint8_t size = 0; size <= 8; ++size) {
    EXPECT_EQ(classic_bits(size, Stuffing::kNone).all(), 47u + 8 * size);
    EXPECT_EQ(classic_bits(size, Stuffing::kWorst).all(), 47u + 8 * size + (33u + 8 * size) / 4);
    EXPECT_EQ(classic_bits(size, Stuffing::kNone, true).all(), 67u + 8 * size);
    EXPECT_EQ(classic_bits(size, Stuffing::kWorst, true).all(),
              67u + 8 * size + (53u + 8 * size) / 4);
  }
  static_assert(classic_bits(8, Stuffing::kWorst).all() == 135);
  static_assert(classic_bits(8, Stuffing::kWorst, true).all() == 160);
}

// Linux, include/linux/can/length.h: header 22, CRC 28 or 33 with delimiter, footer 9, intermission
// 3.
TEST(BusLoad, FdFramesHaveTheKnownLengths) {
  EXPECT_EQ(fd_bits(8, Stuffing::kNone, false).all(), 22u + 64 + 28 + 9 + 3);
  EXPECT_EQ(fd_bits(16, Stuffing::kNone, false).all(), 22u + 128 + 28 + 9 + 3);
  EXPECT_EQ(fd_bits(20, Stuffing::kNone, false).all(), 22u + 160 + 33 + 9 + 3);
  EXPECT_EQ(fd_bits(64, Stuffing::kNone, false).all(), 22u + 512 + 33 + 9 + 3);
  EXPECT_EQ(fd_bits(64, Stuffing::kWorst, false).all(), 22u + 512 + 133 + 33 + 9 + 3);
  EXPECT_TRUE(fd_bits(49, Stuffing::kNone, false) == fd_bits(64, Stuffing::kNone, false));
  for (std::uint8_t code = 0; code < 16; ++code) {
    const std::size_t size = code <= 8 ? code : kCanFdSizes[code - 9];
    for (const Stuffing stuffing : {Stuffing::kNone, Stuffing::kWorst}) {
      const FrameBits switched = fd_bits(size, stuffing, true);
      EXPECT_EQ(switched.all(), fd_bits(size, stuffing, false).all());
      EXPECT_EQ(switched.nominal, stuffing == Stuffing::kNone ? 30u : 34u)
          << "17 before the switch, at worst 4 stuffed, 13 after it";
    }
  }
}

// From start to CRC, as in ISO 11898-1.
unsigned draw(const Frame& frame, unsigned* bits) {
  unsigned count = 0;
  const auto put = [&](std::uint32_t value, unsigned width) {
    while (width > 0) bits[count++] = value >> --width & 1u;
  };
  put(0, 1);
  put(frame.extended ? frame.id >> 18 : frame.id, 11);
  if (frame.extended) put(3, 2), put(frame.id & 0x3FFFF, 18);
  put(0, 3);
  put(frame.size, 4);
  for (unsigned i = 0; i < frame.size; ++i) put(frame.data[i], 8);
  put(classic_crc(frame), 15);
  return count;
}
unsigned stuff_bits(const unsigned* bits, unsigned count) {
  unsigned stuffed = 0;
  unsigned run = 0;
  unsigned last = 2;
  for (unsigned i = 0; i < count; ++i) {
    run = bits[i] == last ? run + 1 : 1;
    last = bits[i];
    if (run == 5) ++stuffed, last = 1 - last, run = 1;
  }
  return stuffed;
}

// Frame and CRC divide by the polynomial. One stuff bit follows each five equal bits.
TEST(BusLoad, ClassicFramesAreCountedBitByBit) {
  test::Dice dice(1);
  for (int run = 0; run < 400; ++run) {
    Frame frame = classic_frame(dice.below(0x800), static_cast<std::uint8_t>(dice.below(9)));
    frame.extended = dice.one_in(2);
    if (frame.extended) frame.id = dice.one_in(4) ? 0 : frame.id << 18 | dice.below(0x40000);
    const bool quiet = dice.one_in(2);
    for (unsigned i = 0; i < frame.size; ++i) {
      frame.data[i] = static_cast<std::uint8_t>(quiet ? 0 : dice.below(256));
    }
    unsigned bits[39 + 64 + 15];
    const unsigned count = draw(frame, bits);
    ASSERT_EQ(exact_bits(frame).all(), count + stuff_bits(bits, count) + 13);
    // By x^15 + x^14 + x^10 + x^8 + x^7 + x^4 + x^3 + 1.
    for (unsigned i = 0; i + 15 < count; ++i) {
      if (bits[i] == 0) continue;
      for (const unsigned power : {15u, 14u, 10u, 8u, 7u, 4u, 3u, 0u}) bits[i + 15 - power] ^= 1u;
    }
    for (unsigned i = 0; i < count; ++i) ASSERT_EQ(bits[i], 0u);
  }
}

TEST(BusLoad, AnExactFrameLiesBetweenNoneAndWorst) {
  test::Dice dice(2);
  for (int run = 0; run < 3000; ++run) {
    Frame frame;
    frame.fd = dice.one_in(2);
    frame.bit_rate_switch = frame.fd && dice.one_in(2);
    frame.extended = dice.one_in(3);
    frame.id = dice.below(frame.extended ? 0x20000000 >> 8 : 0x800);
    frame.size = frame.fd ? can_fd_size(dice.below(65)) : static_cast<std::uint8_t>(dice.below(9));
    const bool quiet = dice.one_in(2);
    for (unsigned i = 0; i < frame.size; ++i) {
      frame.data[i] =
          quiet ? (dice.one_in(9) ? 0x0F : 0) : static_cast<std::uint8_t>(dice.below(256));
    }
    const FrameBits least = frame_bits(frame, Stuffing::kNone);
    const FrameBits exact = exact_bits(frame);
    const FrameBits most = frame_bits(frame, Stuffing::kWorst);
    ASSERT_GE(exact.nominal, least.nominal);
    ASSERT_GE(exact.data, least.data);
    ASSERT_LE(exact.all(), most.all());
    ASSERT_LE(exact.nominal, most.nominal);
  }
}

// The largest frames round least.
TEST(BusLoad, RandomFramesTakeTheExpectedStuffBits) {
  test::Dice dice(3);
  constexpr std::uint32_t kRuns = 4000;
  for (const bool fd : {false, true}) {
    std::uint64_t none = 0, expected = 0, exact = 0;
    for (std::uint32_t run = 0; run < kRuns; ++run) {
      Frame frame;
      frame.fd = fd;
      frame.id = dice.below(0x800);
      frame.size = fd ? 64 : 8;
      for (unsigned i = 0; i < frame.size; ++i) {
        frame.data[i] = static_cast<std::uint8_t>(dice.below(256));
      }
      none += frame_bits(frame, Stuffing::kNone).all();
      expected += frame_bits(frame, Stuffing::kExpected).all();
      exact += exact_bits(frame).all();
    }
    const std::uint64_t few = 3 * (expected - none) / 4, many = 5 * (expected - none) / 4;
    EXPECT_GE(exact - none, few) << fd;
    EXPECT_LE(exact - none, many) << fd;
  }
}

// None after the last bit of an FD frame.
TEST(BusLoad, EqualDataBitsAreStuffedEachFive) {
  Frame frame = classic_frame(0x555, 8);
  frame.fd = true;
  // 0 10101010101 0 0 1 0 0 0 | 1000 | zeros: only data add runs of five.
  const std::uint32_t none = fd_bits(8, Stuffing::kNone, false).all();
  // After the length code's 1 come 67 zeros.
  EXPECT_EQ(exact_bits(frame).all(), none + 13);
  // 40 zeros follow the length code 0101.
  frame.size = 5;
  EXPECT_EQ(exact_bits(frame).all(), fd_bits(5, Stuffing::kNone, false).all() + 7);
}

TEST(BusLoad, TimesAndSharesAreRoundedUp) {
  constexpr BitRates classic;
  static_assert(wire_time_ns({111, 0}, classic) == 111'000);
  EXPECT_EQ(wire_time_ns({1, 1}, {1'000'000, 8'000'000}), 1125u);
  EXPECT_EQ(wire_time_ns({1, 0}, {300'000, 300'000}), 3334u);
  EXPECT_EQ(load_permille({500, 0}, classic, 1000), 500u);
  EXPECT_EQ(load_permille({501, 0}, {1'000'000, 1}, 8000), 63u);
}

// Six bytes each way and a counted SYNC stay under 70 % of 1 Mbit/s, worst-case stuffing.
TEST(BusLoad, TwentyOneDrivesFitAt125HzAndNotAt200) {
  FrameBits tick = classic_bits(6, Stuffing::kWorst) * 42;
  tick += classic_bits(1, Stuffing::kWorst);
  EXPECT_LE(load_permille(tick, {}, 8000), 700u);
  EXPECT_GT(load_permille(tick, {}, 5000), 700u);
}

TEST(BusLoad, AnFdFrameShorterThanItsLengthCodeIsFilledWithZeros) {
  test::Dice dice(4);
  for (std::uint8_t size = 0; size <= 64; ++size) {
    Frame frame;
    frame.fd = true;
    frame.bit_rate_switch = dice.one_in(2);
    frame.id = dice.below(0x800);
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(dice.below(256));
    frame.size = size;
    Frame filled = frame;
    filled.size = can_fd_size(size);
    for (unsigned i = size; i < filled.size; ++i) filled.data[i] = 0;
    EXPECT_TRUE(exact_bits(frame) == exact_bits(filled)) << int{size};
  }
}

}  // namespace
}  // namespace verp::canopen
