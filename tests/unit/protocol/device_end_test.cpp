#include "common/protocol/device_end.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>

// Sequences are the examples of ROBOTIS e-Manual, "DYNAMIXEL Protocol 2.0".

namespace verp::dxl {
namespace {

struct Received {
  template <std::size_t kSize>
  explicit Received(const std::uint8_t (&bytes)[kSize]) {
    for (const std::uint8_t byte : bytes) complete = parser.push(byte);
  }
  const Packet& packet() const { return parser.packet(); }
  Parser parser;
  bool complete = false;
};

TEST(DeviceEnd, KnowsTheRequestsThatChangeNothing) {
  for (const Instruction each :
       {Instruction::kPing, Instruction::kRead, Instruction::kSyncRead, Instruction::kFastSyncRead,
        Instruction::kBulkRead, Instruction::kFastBulkRead}) {
    EXPECT_TRUE(is_read(each)) << static_cast<int>(each);
  }
  for (const Instruction each :
       {Instruction::kWrite, Instruction::kRegWrite, Instruction::kAction,
        Instruction::kFactoryReset, Instruction::kReboot, Instruction::kClear,
        Instruction::kSyncWrite, Instruction::kBulkWrite, Instruction::kStatus}) {
    EXPECT_FALSE(is_read(each)) << static_cast<int>(each);
  }
}

TEST(DeviceEnd, FindsItsPartOfTheDocumentedSyncRead) {
  const std::uint8_t bytes[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x09, 0x00, 0x82,
                                0x84, 0x00, 0x04, 0x00, 0x01, 0x02, 0xCE, 0xFA};
  const Received received(bytes);
  ASSERT_TRUE(received.complete);
  ReadEntry entry;
  for (std::uint8_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(read_entry(received.packet(), i, entry));
    EXPECT_EQ(entry.id, i + 1);
    EXPECT_EQ(entry.address, 132);
    EXPECT_EQ(entry.length, 4);
  }
  EXPECT_FALSE(read_entry(received.packet(), 2, entry));
  std::size_t offset = 0;
  WriteEntry write;
  EXPECT_FALSE(write_entry(received.packet(), offset, write)) << "a read brings nothing to write";
}

TEST(DeviceEnd, FindsItsPartOfTheDocumentedBulkRead) {
  const std::uint8_t bytes[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x0D, 0x00, 0x92, 0x01, 0x90,
                                0x00, 0x02, 0x00, 0x02, 0x92, 0x00, 0x01, 0x00, 0x1A, 0x05};
  const Received received(bytes);
  ASSERT_TRUE(received.complete);
  ReadEntry entry;
  ASSERT_TRUE(read_entry(received.packet(), 1, entry));
  EXPECT_EQ(entry.id, 2);
  EXPECT_EQ(entry.address, 146);
  EXPECT_EQ(entry.length, 1);
  EXPECT_FALSE(read_entry(received.packet(), 2, entry));
}

TEST(DeviceEnd, FindsItsPartOfTheDocumentedSyncWrite) {
  const std::uint8_t bytes[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x11, 0x00, 0x83,
                                0x74, 0x00, 0x04, 0x00, 0x01, 0x96, 0x00, 0x00,
                                0x00, 0x02, 0xAA, 0x00, 0x00, 0x00, 0x82, 0x87};
  const Received received(bytes);
  ASSERT_TRUE(received.complete);
  const std::uint32_t goals[] = {0x96, 0xAA};
  std::size_t offset = 0;
  WriteEntry entry;
  for (std::uint8_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(write_entry(received.packet(), offset, entry));
    EXPECT_EQ(entry.id, i + 1);
    EXPECT_EQ(entry.address, 116);
    ASSERT_EQ(entry.size, 4u);
    EXPECT_EQ(get_u32(entry.data), goals[i]);
  }
  EXPECT_FALSE(write_entry(received.packet(), offset, entry));
}

TEST(DeviceEnd, FindsItsPartOfTheDocumentedBulkWrite) {
  const std::uint8_t bytes[] = {0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x10, 0x00, 0x93,
                                0x01, 0x20, 0x00, 0x02, 0x00, 0xA0, 0x00, 0x02,
                                0x1F, 0x00, 0x01, 0x00, 0x50, 0xB7, 0x68};
  const Received received(bytes);
  ASSERT_TRUE(received.complete);
  std::size_t offset = 0;
  WriteEntry entry;
  ASSERT_TRUE(write_entry(received.packet(), offset, entry));
  EXPECT_EQ(entry.address, 32);
  ASSERT_EQ(entry.size, 2u);
  EXPECT_EQ(get_u16(entry.data), 160);
  ASSERT_TRUE(write_entry(received.packet(), offset, entry));
  EXPECT_EQ(entry.id, 2);
  EXPECT_EQ(entry.address, 31);
  ASSERT_EQ(entry.size, 1u);
  EXPECT_EQ(entry.data[0], 80);
  EXPECT_FALSE(write_entry(received.packet(), offset, entry));
}

TEST(DeviceEnd, NoEntryReachesPastThePacket) {
  std::uint8_t parameters[24];
  std::uint32_t random = 1;
  for (int round = 0; round < 4000; ++round) {
    for (std::uint8_t& byte : parameters) {
      random = random * 1664525u + 1013904223u;
      byte = static_cast<std::uint8_t>((random >> 24) % 7);
    }
    Packet packet;
    packet.parameters = parameters;
    packet.size = random % (sizeof parameters + 1);
    for (const Instruction each : {Instruction::kSyncWrite, Instruction::kBulkWrite}) {
      packet.instruction = each;
      WriteEntry entry;
      int entries = 0;
      for (std::size_t offset = 0; write_entry(packet, offset, entry); ++entries) {
        ASSERT_LE(entry.data + entry.size, parameters + packet.size);
        ASSERT_LE(offset, packet.size);
        ASSERT_LE(entries, static_cast<int>(packet.size));
      }
    }
    for (const Instruction each : {Instruction::kSyncRead, Instruction::kBulkRead}) {
      packet.instruction = each;
      ReadEntry entry;
      std::size_t entries = 0;
      while (read_entry(packet, entries, entry)) ++entries;
      ASSERT_LE(entries, packet.size);
    }
  }
}

// Signed at 10 within [-5, 300], read-only at 12.
WriteRule two_registers(std::uint16_t address) {
  if (address == 10) return {2, true, -5, 300};
  if (address == 12) return {1, false, 0, 255};
  return {};
}

TEST(CheckWrite, GivesTheDocumentedErrors) {
  const std::uint8_t low[] = {0xFB, 0xFF};       // -5
  const std::uint8_t too_low[] = {0xFA, 0xFF};   // -6
  const std::uint8_t too_high[] = {0x2D, 0x01};  // 301
  const std::uint8_t good_then_more[] = {1, 0, 0};
  EXPECT_TRUE(check_write(10, low, 2, two_registers) == Error::kNone);
  EXPECT_TRUE(check_write(10, too_low, 2, two_registers) == Error::kDataRange);
  EXPECT_TRUE(check_write(10, too_high, 2, two_registers) == Error::kDataRange);
  EXPECT_TRUE(check_write(10, low, 1, two_registers) == Error::kDataLength) << "half a register";
  EXPECT_TRUE(check_write(10, low, 0, two_registers) == Error::kDataLength);
  EXPECT_TRUE(check_write(12, low, 1, two_registers) == Error::kAccess) << "read only";
  EXPECT_TRUE(check_write(10, good_then_more, 3, two_registers) == Error::kAccess);
  EXPECT_TRUE(check_write(11, low, 1, two_registers) == Error::kAccess) << "not its beginning";
  EXPECT_TRUE(check_write(0xFFFF, low, 2, two_registers) == Error::kAccess);
}

}  // namespace
}  // namespace verp::dxl
