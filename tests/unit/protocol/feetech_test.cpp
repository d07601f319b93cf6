#include "common/protocol/feetech.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "common/protocol/feetech_table.hpp"

// "Manual": the examples of Feetech's Communication Protocol User Manual.
namespace verp::feetech {
namespace {

template <std::size_t n>
bool same(const std::uint8_t* frame, std::size_t size, const std::uint8_t (&documented)[n]) {
  bool equal = size == n;
  for (std::size_t i = 0; i < n && equal; ++i) equal = frame[i] == documented[i];
  return equal;
}

template <std::size_t n>
int packets_in(Parser& parser, const std::uint8_t (&bytes)[n]) {
  int count = 0;
  for (const std::uint8_t byte : bytes) {
    for (bool found = parser.push(byte); found; found = parser.next()) ++count;
  }
  return count;
}

TEST(Feetech, EncodesWhatTheManualDocuments) {
  std::uint8_t frame[64];
  constexpr std::uint8_t kPing[] = {0xFF, 0xFF, 0x01, 0x02, 0x01, 0xFB};
  EXPECT_TRUE(same(frame, encode_ping(frame, sizeof frame, 1), kPing));
  constexpr std::uint8_t kRead[] = {0xFF, 0xFF, 0x01, 0x04, 0x02, 0x38, 0x02, 0xBE};
  EXPECT_TRUE(same(frame, encode_read(frame, sizeof frame, 1, 0x38, 2), kRead));
  constexpr std::uint8_t kGoal[] = {0x00, 0x08, 0x00, 0x00, 0xE8, 0x03};
  constexpr std::uint8_t kWrite[] = {0xFF, 0xFF, 0x01, 0x09, 0x03, 0x2A, 0x00,
                                     0x08, 0x00, 0x00, 0xE8, 0x03, 0xD5};
  EXPECT_TRUE(same(frame, encode_write(frame, sizeof frame, 1, 0x2A, kGoal, sizeof kGoal), kWrite));
  constexpr std::uint8_t kIds[] = {1, 2};
  constexpr std::uint8_t kSyncRead[] = {0xFF, 0xFF, 0xFE, 0x06, 0x82, 0x38, 0x08, 0x01, 0x02, 0x36};
  EXPECT_TRUE(same(frame, encode_sync_read(frame, sizeof frame, 0x38, 8, kIds, 2), kSyncRead));
}

TEST(Feetech, EncodesTheManualsSyncWrite) {
  std::uint8_t frame[64];
  Encoder encoder(frame, sizeof frame);
  begin_sync_write(encoder, 0x2A, 6);
  for (std::uint8_t id = 1; id <= 4; ++id) {
    encoder.u8(id);
    encoder.u16(2048);
    encoder.u16(0);
    encoder.u16(1000);
  }
  constexpr std::uint8_t kSyncWrite[] = {0xFF, 0xFF, 0xFE, 0x20, 0x83, 0x2A, 0x06, 0x01, 0x00,
                                         0x08, 0x00, 0x00, 0xE8, 0x03, 0x02, 0x00, 0x08, 0x00,
                                         0x00, 0xE8, 0x03, 0x03, 0x00, 0x08, 0x00, 0x00, 0xE8,
                                         0x03, 0x04, 0x00, 0x08, 0x00, 0x00, 0xE8, 0x03, 0x58};
  EXPECT_TRUE(same(frame, encoder.finish(), kSyncWrite));
}

TEST(Feetech, ReadsTheManualsAnswers) {
  static Parser parser;
  constexpr std::uint8_t kPosition[] = {0xFF, 0xFF, 0x01, 0x04, 0x00, 0x18, 0x05, 0xDD};
  EXPECT_EQ(packets_in(parser, kPosition), 1);
  EXPECT_EQ(parser.packet().id, 1);
  EXPECT_EQ(parser.packet().code, 0);
  ASSERT_EQ(parser.packet().size, 2u);
  EXPECT_EQ(get_u16(parser.packet().parameters), 1304);
  constexpr std::uint8_t kBoth[] = {0xFF, 0xFF, 0x01, 0x0A, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00,
                                    0x00, 0x79, 0x1E, 0x55, 0xFF, 0xFF, 0x02, 0x0A, 0x00, 0xFF,
                                    0x07, 0x00, 0x00, 0x00, 0x00, 0x77, 0x23, 0x53};
  EXPECT_EQ(packets_in(parser, kBoth), 2);
  EXPECT_EQ(get_u16(parser.packet().parameters), 2047);
}

TEST(Feetech, NoiseAndADamagedPacketCostNoOther) {
  static Parser parser;
  constexpr std::uint8_t kBytes[] = {
      0x00, 0xFF, 0x12, 0xFF, 0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFC,  // one FF more than a header
      0xFF, 0xFF, 0x01, 0x02, 0x00, 0xFD,                          // a wrong checksum
      0xFF, 0xFF, 0x02, 0x01, 0xFF, 0xFF, 0x02, 0x02, 0x00, 0xFB,  // a length that none has
      0xFF, 0xFF, 0x03, 0x09, 0x00, 0xFF, 0xFF, 0x03, 0x02, 0x00, 0xFA};  // one cut, and one whole
  EXPECT_EQ(packets_in(parser, kBytes), 2);
  EXPECT_EQ(parser.checksum_errors(), 1u);
  EXPECT_GT(parser.noise_bytes(), 0u);
  std::uint8_t rest[8] = {};
  EXPECT_EQ(packets_in(parser, rest), 1) << "the cut packet's length is over";
  EXPECT_EQ(parser.packet().id, 3);
}

TEST(Feetech, APacketWithItsLongestLengthFits) {
  static Parser parser;
  static std::uint8_t frame[kMaxPacket + 8];
  static std::uint8_t data[kMostParameters + 1] = {};
  const std::size_t size = encode_status(frame, sizeof frame, 7, 0, data, kMostParameters);
  ASSERT_EQ(size, kMaxPacket);
  EXPECT_EQ(encode_status(frame, sizeof frame, 7, 0, data, kMostParameters + 1), 0u);
  EXPECT_EQ(encode_status(frame, 6, 7, 0, data, 1), 0u);
  encode_status(frame, sizeof frame, 7, 0, data, kMostParameters);
  int found = 0;
  for (std::size_t i = 0; i < size; ++i) found += parser.push(frame[i]) ? 1 : 0;
  EXPECT_EQ(found, 1);
}

TEST(Feetech, SignsAreMagnitudes) {
  static_assert(from_magnitude(to_magnitude(-100, kSign), kSign) == -100);
  EXPECT_EQ(to_magnitude(-100, kSign), 0x8064);
  EXPECT_EQ(to_magnitude(-100, kOffsetSign), 0x0864);
  EXPECT_EQ(from_magnitude(0x0BFF, kOffsetSign), -1023);
  EXPECT_EQ(from_magnitude(0x0464, kLoadSign), -100);
  EXPECT_EQ(from_magnitude(0x8000, kSign), 0);
  EXPECT_EQ(to_magnitude(5000, kOffsetSign), 2047) << "the nearest one";
  EXPECT_EQ(to_magnitude(-5000, kOffsetSign), 0x0FFF);
}

TEST(Feetech, AnEchoIsOnlyTheVeryBytesThatWereSent) {
  static Parser parser;
  std::uint8_t frame[16];
  const std::size_t size = encode_read(frame, sizeof frame, 1, 0x38, 2);
  for (std::size_t i = 0; i < size; ++i) parser.push(frame[i]);
  EXPECT_TRUE(parser.packet().is(frame, size));
  frame[5] ^= 1;
  EXPECT_FALSE(parser.packet().is(frame, size));
  EXPECT_FALSE(parser.packet().is(frame, size - 1));
}

}  // namespace
}  // namespace verp::feetech
