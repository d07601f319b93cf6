#include "common/protocol/dynamixel2.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "common/protocol/control_table.hpp"

// "Documented" sequences are the examples of ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0".

namespace verp::dxl {
namespace {

template <std::size_t kSize>
bool equal(const std::uint8_t* bytes, std::size_t size, const std::uint8_t (&expected)[kSize]) {
  if (size != kSize) return false;
  for (std::size_t i = 0; i < kSize; ++i) {
    if (bytes[i] != expected[i]) return false;
  }
  return true;
}

// Returns the packets found, the last one in `last`.
int feed(Parser& parser, const std::uint8_t* bytes, std::size_t size, Packet& last) {
  int packets = 0;
  for (std::size_t i = 0; i < size; ++i) {
    for (bool found = parser.push(bytes[i]); found; found = parser.next()) {
      ++packets;
      last = parser.packet();
    }
  }
  return packets;
}

// xorshift32, the same on every core.
struct Random {
  std::uint32_t state = 2463534242u;
  std::uint32_t next() {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(next() >> 24); }
};

TEST(Crc16, DetectsTheDocumentedValues) {
  const std::uint8_t ping[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01};
  EXPECT_EQ(crc16(ping, sizeof ping), 0x4E19);
  EXPECT_EQ(crc16(ping, 0), 0);
  // CRC-16/UMTS (0x8005, initial value 0) over "123456789".
  const std::uint8_t check[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc16(check, sizeof check), 0xFEE8);
}

TEST(Crc16, ContinuesAcrossParts) {
  const std::uint8_t bytes[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01};
  EXPECT_EQ(crc16(bytes + 3, 5, crc16(bytes, 3)), crc16(bytes, sizeof bytes));
}

TEST(Encode, PingIsAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t one[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E};
  EXPECT_TRUE(equal(bytes, encode_ping(bytes, sizeof bytes, 1), one));
  const std::uint8_t all[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x03, 0x00, 0x01, 0x31, 0x42};
  EXPECT_TRUE(equal(bytes, encode_ping(bytes, sizeof bytes, kBroadcast), all));
}

TEST(Encode, PingStatusIsAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t identity[] = {0x06, 0x04, 0x26};
  const std::uint8_t one[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                              0x55, 0x00, 0x06, 0x04, 0x26, 0x65, 0x5D};
  EXPECT_TRUE(equal(bytes, encode_status(bytes, sizeof bytes, 1, 0, identity, 3), one));
  const std::uint8_t two[] = {0xFF, 0xFF, 0xFD, 0x00, 0x02, 0x07, 0x00,
                              0x55, 0x00, 0x06, 0x04, 0x26, 0x6F, 0x6D};
  EXPECT_TRUE(equal(bytes, encode_status(bytes, sizeof bytes, 2, 0, identity, 3), two));
}

TEST(Encode, ReadAndItsStatusAreAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t read[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                               0x02, 0x84, 0x00, 0x04, 0x00, 0x1D, 0x15};
  EXPECT_TRUE(
      equal(bytes, encode_read(bytes, sizeof bytes, 1, address::kPresentPosition, 4), read));
  const std::uint8_t position[] = {0xA6, 0x00, 0x00, 0x00};
  const std::uint8_t status[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55,
                                 0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0};
  EXPECT_TRUE(equal(bytes, encode_status(bytes, sizeof bytes, 1, 0, position, 4), status));
}

TEST(Encode, WriteAndItsStatusAreAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t goal[] = {0x00, 0x02, 0x00, 0x00};
  const std::uint8_t write[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x03,
                                0x74, 0x00, 0x00, 0x02, 0x00, 0x00, 0xCA, 0x89};
  EXPECT_TRUE(
      equal(bytes, encode_write(bytes, sizeof bytes, 1, address::kGoalPosition, goal, 4), write));
  const std::uint8_t status[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x55, 0x00, 0xA1, 0x0C};
  EXPECT_TRUE(equal(bytes, encode_status(bytes, sizeof bytes, 1, 0, nullptr, 0), status));
}

TEST(Encode, SyncReadIsAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t ids[] = {1, 2};
  const std::uint8_t expected[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x09, 0x00, 0x82,
                                   0x84, 0x00, 0x04, 0x00, 0x01, 0x02, 0xCE, 0xFA};
  EXPECT_TRUE(equal(bytes,
                    encode_sync_read(bytes, sizeof bytes, Instruction::kSyncRead,
                                     address::kPresentPosition, 4, ids, 2),
                    expected));
}

TEST(Encode, SyncWriteIsAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  Encoder encoder(bytes, sizeof bytes);
  begin_sync_write(encoder, address::kGoalPosition, 4);
  encoder.u8(1);
  encoder.u32(0x96);
  encoder.u8(2);
  encoder.u32(0xAA);
  const std::uint8_t expected[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x11, 0x00, 0x83,
                                   0x74, 0x00, 0x04, 0x00, 0x01, 0x96, 0x00, 0x00,
                                   0x00, 0x02, 0xAA, 0x00, 0x00, 0x00, 0x82, 0x87};
  EXPECT_TRUE(equal(bytes, encoder.finish(), expected));
}

TEST(Encode, RegWriteAndActionAreAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t velocity[] = {0xC8, 0x00, 0x00, 0x00};
  const std::uint8_t reg_write[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x09, 0x00, 0x04,
                                    0x68, 0x00, 0xC8, 0x00, 0x00, 0x00, 0xAE, 0x8E};
  EXPECT_TRUE(equal(bytes,
                    encode_reg_write(bytes, sizeof bytes, 1, address::kGoalVelocity, velocity, 4),
                    reg_write));
  const std::uint8_t action[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x05, 0x02, 0xCE};
  EXPECT_TRUE(equal(bytes, encode_plain(bytes, sizeof bytes, 1, Instruction::kAction), action));
}

TEST(Encode, ResetRebootAndClearAreAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t reset[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x06, 0x01, 0xA1, 0xE6};
  EXPECT_TRUE(equal(bytes, encode_factory_reset(bytes, sizeof bytes, 1, Reset::kAllButId), reset));
  const std::uint8_t reboot[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x08, 0x2F, 0x4E};
  EXPECT_TRUE(equal(bytes, encode_plain(bytes, sizeof bytes, 1, Instruction::kReboot), reboot));
  const std::uint8_t clear[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x10,
                                0x01, 0x44, 0x58, 0x4C, 0x22, 0xB1, 0xDC};
  EXPECT_TRUE(equal(bytes, encode_clear_turns(bytes, sizeof bytes, 1), clear));
}

TEST(Encode, BulkReadAndWriteAreAsDocumented) {
  std::uint8_t bytes[kMaxPacket];
  Encoder read(bytes, sizeof bytes);
  begin_bulk(read, Instruction::kBulkRead);
  bulk_entry(read, 1, address::kPresentVoltage, 2);
  bulk_entry(read, 2, address::kPresentTemperature, 1);
  const std::uint8_t bulk_read[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0D, 0x00, 0x92, 0x01, 0x90,
                                    0x00, 0x02, 0x00, 0x02, 0x92, 0x00, 0x01, 0x00, 0x1A, 0x05};
  EXPECT_TRUE(equal(bytes, read.finish(), bulk_read));

  Encoder write(bytes, sizeof bytes);
  begin_bulk(write, Instruction::kBulkWrite);
  bulk_entry(write, 1, address::kMaxVoltageLimit, 2);
  write.u16(160);
  bulk_entry(write, 2, address::kTemperatureLimit, 1);
  write.u8(80);
  const std::uint8_t bulk_write[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x10, 0x00, 0x93,
                                     0x01, 0x20, 0x00, 0x02, 0x00, 0xA0, 0x00, 0x02,
                                     0x1F, 0x00, 0x01, 0x00, 0x50, 0xB7, 0x68};
  EXPECT_TRUE(equal(bytes, write.finish(), bulk_write));
}

TEST(Encode, RefusesWhatDoesNotFitAndWritesNothingPastTheEnd) {
  std::uint8_t bytes[16];
  for (std::size_t capacity = 0; capacity < 10; ++capacity) {
    for (std::uint8_t& byte : bytes) byte = 0x5A;
    EXPECT_EQ(encode_ping(bytes, capacity, 1), 0u);
    for (std::size_t i = capacity; i < sizeof bytes; ++i) EXPECT_EQ(bytes[i], 0x5A);
  }
  EXPECT_EQ(encode_ping(bytes, 10, 1), 10u);
}

TEST(Stuffing, InsertsOneByteAfterEachHeaderPattern) {
  std::uint8_t bytes[kMaxPacket];
  const std::uint8_t data[] = {0xFF, 0xFF, 0xFD, 0xFD, 0xFF, 0xFF, 0xFD};
  const std::size_t size = encode_status(bytes, sizeof bytes, 1, 0, data, sizeof data);
  EXPECT_EQ(size, kStatusBytes + sizeof data + 2);
  const std::uint8_t stuffed[] = {0xFF, 0xFF, 0xFD, 0xFD, 0xFD, 0xFF, 0xFF, 0xFD, 0xFD};
  EXPECT_TRUE(equal(bytes + 9, sizeof stuffed, stuffed));
}

TEST(Stuffing, RoundTripsAnyBytes) {
  Random random;
  const std::uint8_t alphabet[] = {0xFF, 0xFF, 0xFD, 0x00, 0x55};
  Parser parser;
  for (int round = 0; round < 2000; ++round) {
    std::uint8_t data[64];
    const std::size_t size = random.next() % (sizeof data + 1);
    for (std::size_t i = 0; i < size; ++i) data[i] = alphabet[random.next() % 5];
    std::uint8_t bytes[kMaxPacket];
    const std::size_t length = encode_status(bytes, sizeof bytes, 7, kAlert | 4, data, size);
    ASSERT_GT(length, 0u);
    for (std::size_t i = 1; i + 6 <= length; ++i) {
      const bool header =
          bytes[i] == 0xFF && bytes[i + 1] == 0xFF && bytes[i + 2] == 0xFD && bytes[i + 3] == 0;
      ASSERT_FALSE(header);
    }
    Packet packet;
    ASSERT_EQ(feed(parser, bytes, length, packet), 1);
    ASSERT_TRUE(packet.is_status());
    ASSERT_EQ(packet.id, 7);
    ASSERT_EQ(packet.error, kAlert | 4);
    ASSERT_EQ(packet.size, size);
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(packet.parameters[i], data[i]);
  }
  EXPECT_EQ(parser.crc_errors(), 0u);
  EXPECT_EQ(parser.noise_bytes(), 0u);
}

TEST(Parser, ReadsInstructionsToo) {
  const std::uint8_t read[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00,
                               0x02, 0x84, 0x00, 0x04, 0x00, 0x1D, 0x15};
  Parser parser;
  Packet packet;
  ASSERT_EQ(feed(parser, read, sizeof read, packet), 1);
  EXPECT_FALSE(packet.is_status());
  EXPECT_TRUE(packet.instruction == Instruction::kRead);
  ASSERT_EQ(packet.size, 4u);
  EXPECT_EQ(get_u16(packet.parameters), address::kPresentPosition);
}

TEST(Parser, FindsAGoodPacketAfterNoise) {
  Random random;
  for (int round = 0; round < 2000; ++round) {
    Parser parser;
    Packet packet;
    std::uint8_t noise[48];
    const std::size_t size = random.next() % sizeof noise;
    for (std::size_t i = 0; i < size; ++i) {
      noise[i] = (random.next() & 1) != 0 ? 0xFF : random.byte();
    }
    feed(parser, noise, size, packet);
    std::uint8_t good[32];
    const std::uint8_t data[] = {1, 2, 3, 4};
    const std::size_t length = encode_status(good, sizeof good, 9, 0, data, sizeof data);
    // A false header may claim bytes of the good packet.
    int packets = feed(parser, good, length, packet);
    for (int filler = 0; packets == 0 && filler < static_cast<int>(kMaxPacket); ++filler) {
      const std::uint8_t zero = 0;
      packets += feed(parser, &zero, 1, packet);
    }
    ASSERT_EQ(packets, 1);
    ASSERT_EQ(packet.id, 9);
  }
}

TEST(Parser, FindsTheReplyBehindACutOne) {
  std::uint8_t bytes[64];
  const std::uint8_t data[] = {1, 2, 3, 4};
  const std::size_t cut = encode_status(bytes, sizeof bytes, 3, 0, data, sizeof data) - 5;
  const std::size_t good = encode_status(bytes + cut, sizeof bytes - cut, 4, 0, data, sizeof data);
  Parser parser;
  Packet packet;
  EXPECT_EQ(feed(parser, bytes, cut + good, packet), 1);
  EXPECT_EQ(packet.id, 4);
  EXPECT_EQ(parser.crc_errors(), 1u);
}

TEST(Parser, RejectsEveryFlippedBit) {
  std::uint8_t good[32];
  const std::uint8_t data[] = {0xA6, 0x00, 0x12, 0x34};
  const std::size_t length = encode_status(good, sizeof good, 1, 0, data, sizeof data);
  for (std::size_t bit = 0; bit < length * 8; ++bit) {
    std::uint8_t bad[32] = {};
    for (std::size_t i = 0; i < length; ++i) bad[i] = good[i];
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ 1u << bit % 8);
    Parser parser;
    Packet packet;
    ASSERT_EQ(feed(parser, bad, length, packet), 0);
    const bool in_body = bit >= 7 * 8;
    if (in_body) {
      ASSERT_EQ(parser.crc_errors(), 1u);
    }
  }
}

TEST(Parser, IgnoresLengthsThatCannotBe) {
  const std::uint8_t too_short[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x02, 0x00};
  const std::uint8_t too_long[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0xFF, 0x7F};
  const std::uint8_t ping[] = {0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x03, 0x00, 0x01, 0x19, 0x4E};
  Parser parser;
  Packet packet;
  EXPECT_EQ(feed(parser, too_short, sizeof too_short, packet), 0);
  EXPECT_EQ(feed(parser, ping, sizeof ping, packet), 1);
  EXPECT_EQ(feed(parser, too_long, sizeof too_long, packet), 0);
  EXPECT_EQ(feed(parser, ping, sizeof ping, packet), 1);
  EXPECT_EQ(parser.noise_bytes(), 14u);
}

// Each block's CRC covers all bytes before it; there is no stuffing.
TEST(FastSyncRead, BlocksOfAllDevicesMakeOnePacket) {
  std::uint8_t bytes[64];
  const std::uint8_t first[] = {0xFF, 0xFF, 0xFD, 0x00};
  const std::uint8_t second[] = {0x1F, 0x08, 0x00, 0x00};
  std::uint16_t crc = 0;
  std::size_t size = encode_fast_block(bytes, true, 2 * (4 + kFastBlockBytes), 1, 0, first, 4, crc);
  EXPECT_EQ(size, kFastHeaderBytes + kFastBlockBytes + 4);
  EXPECT_EQ(get_u16(bytes + size - 2), crc16(bytes, size - 2));
  size += encode_fast_block(bytes + size, false, 0, 2, kAlert, second, 4, crc);
  EXPECT_EQ(get_u16(bytes + 5), size - kHeaderBytes);

  Parser parser;
  Packet packet;
  ASSERT_EQ(feed(parser, bytes, size, packet), 1);
  ASSERT_TRUE(packet.is_fast_reply());
  FastBlock block;
  ASSERT_TRUE(fast_block(packet, 0, 4, block));
  EXPECT_EQ(block.id, 1);
  EXPECT_EQ(block.error, 0);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(block.data[i], first[i]);
  ASSERT_TRUE(fast_block(packet, 1, 4, block));
  EXPECT_EQ(block.id, 2);
  EXPECT_EQ(block.error, kAlert);
  EXPECT_FALSE(fast_block(packet, 2, 4, block));
}

TEST(BaudRate, HasTheServosCodes) {
  EXPECT_EQ(baud_rate_code(57600), 1);
  EXPECT_EQ(baud_rate_code(2000000), 4);
  EXPECT_EQ(baud_rate_code(12345), 0xFF);
}

}  // namespace
}  // namespace verp::dxl
