#include "common/protocol/canopen/pdo.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/drive_objects.hpp"
#include "common/protocol/canopen/pdo_record.hpp"
#include "tests/unit/canopen/sdo_bench.hpp"

namespace verp::canopen {
namespace {

using test::Dice;

// Index 2000h and up, in order.
template <std::size_t kEntries>
PdoMapping<kEntries> random_mapping(Dice& dice, unsigned max_bits) {
  PdoMapping<kEntries> mapping;
  while (mapping.count < kEntries) {
    Mapped entry{{static_cast<std::uint16_t>(0x2000 + mapping.count), 0},
                 static_cast<std::uint8_t>(1 + dice.below(64))};
    if (dice.one_in(4)) entry = dice.one_in(2) ? kDummyU16 : kDummyU8;
    if (mapping.bits() + entry.bits > max_bits) break;
    mapping.add(entry);
  }
  return mapping;
}

template <std::size_t kEntries>
void expect_round_trips(bool fd, std::uint32_t seed) {
  Dice dice(seed);
  for (int run = 0; run < 300; ++run) {
    const PdoMapping<kEntries> mapping = random_mapping<kEntries>(dice, fd ? 512 : 64);
    std::uint64_t values[kEntries] = {};
    for (std::uint64_t& each : values) {
      each = std::uint64_t{dice.below(1 << 24)} << 40 ^ std::uint64_t{dice.below(1 << 24)} << 20 ^
             dice.below(1 << 24);
    }
    Frame frame;
    frame.fd = fd;
    for (std::uint8_t& each : frame.data) each = 0xFF;
    pack_pdo(mapping, frame, [&](Address at, unsigned) { return values[at.index - 0x2000]; });
    ASSERT_EQ(frame.size, fd ? can_fd_size(mapping.bytes()) : mapping.bytes());
    unsigned seen = 0;
    const PdoLength length =
        unpack_pdo(mapping, frame, [&](Address at, unsigned bits, std::uint64_t value) {
          const unsigned which = at.index - 0x2000u;
          ASSERT_LT(which, unsigned{mapping.count});
          EXPECT_EQ(bits, mapping.entries[which].bits);
          EXPECT_EQ(value, low_bits(values[which], bits));
          ++seen;
        });
    EXPECT_TRUE(length == PdoLength::kRight);
    unsigned real = 0;
    for (unsigned i = 0; i < mapping.count; ++i) real += dummy_bits(mapping.entries[i].at) == 0;
    EXPECT_EQ(seen, real) << "each object once, dummies not at all";
  }
}

TEST(Pdo, UnpackingIsTheInverseOfPackingForAnyMapping) {
  expect_round_trips<8>(false, 1);
  expect_round_trips<64>(true, 2);
}

TEST(Pdo, BytesAreLittleEndianInTheOrderOfTheMapping) {
  PdoMapping<> mapping;
  EXPECT_TRUE(mapping.add(Mapped::from(0x60400010)));
  EXPECT_TRUE(mapping.add(Mapped::from(0x607A0020)));
  EXPECT_TRUE((mapping.entries[1] == Mapped{cia402::object::kTargetPosition, 32}));
  EXPECT_EQ(mapping.entries[1].value(), 0x607A0020u);
  Frame frame;
  pack_pdo(mapping, frame, [](Address at, unsigned) {
    return at == cia402::object::kControlword ? std::uint64_t{0x000F} : std::uint64_t{0x12345678};
  });
  const std::uint8_t bytes[] = {0x0F, 0x00, 0x78, 0x56, 0x34, 0x12};
  EXPECT_EQ(frame.size, 6);
  for (unsigned i = 0; i < 6; ++i) EXPECT_EQ(frame.data[i], bytes[i]);
}

struct Device {
  PdoMapping<> mapping;
  std::uint64_t wanted;
};

TEST(Pdo, DummiesLetDevicesShareAnRpdo) {
  PdoMapping<> first;
  PdoMapping<> second;
  first.add({cia402::object::kTargetPosition, 32});
  first.add(kDummyU32);
  second.add(kDummyU32);
  second.add({cia402::object::kTargetPosition, 32});
  Frame frame = classic_frame(0x201, 8);
  put_le(frame.data, 0x2222222211111111, 8);
  for (const Device& device : {Device{first, 0x11111111}, Device{second, 0x22222222}}) {
    int puts = 0;
    unpack_pdo(device.mapping, frame, [&](Address, unsigned, std::uint64_t value) {
      EXPECT_EQ(value, device.wanted);
      ++puts;
    });
    EXPECT_EQ(puts, 1);
  }
}

TEST(Pdo, TooShortIsNotProcessedAndTooLongIs) {
  PdoMapping<> mapping;
  mapping.add({cia402::object::kTargetPosition, 32});
  int puts = 0;
  const auto count = [&](Address, unsigned, std::uint64_t) { ++puts; };
  EXPECT_TRUE(unpack_pdo(mapping, classic_frame(0x201, 3), count) == PdoLength::kTooShort);
  EXPECT_EQ(puts, 0);
  EXPECT_TRUE(unpack_pdo(mapping, classic_frame(0x201, 5), count) == PdoLength::kTooLong);
  EXPECT_EQ(puts, 1);
}

Abort any_drive_object(Address at, std::uint8_t bits) {
  return cia402::check_mappable(at, bits, true);
}

TEST(PdoRecord, ChangesItsMappingOnlyInTheStandardsOrder) {
  PdoRecord<> record(Direction::kReceive, 0x205, 1, {});
  const std::uint32_t target = 0x607A0020;
  EXPECT_TRUE(record.write_mapping(1, target, any_drive_object) == Abort::kUnsupportedAccess)
      << "it is on";
  EXPECT_TRUE(record.write_communication(1, 0x205 | kPdoInvalid) == Abort::kNone);
  EXPECT_FALSE(record.on());
  EXPECT_TRUE(record.write_mapping(1, target, any_drive_object) == Abort::kNone);
  EXPECT_TRUE(record.write_mapping(2, 0x60400010, any_drive_object) == Abort::kNone);
  EXPECT_EQ(record.mapping().count, 0) << "not before subindex 0 says so";
  EXPECT_TRUE(record.write_mapping(0, 2, any_drive_object) == Abort::kNone);
  EXPECT_TRUE(record.write_mapping(1, target, any_drive_object) == Abort::kUnsupportedAccess)
      << "subindex 0 is not 0";
  EXPECT_TRUE(record.write_communication(1, 0x205) == Abort::kNone);
  EXPECT_EQ(record.mapping().bytes(), 6u);
  std::uint32_t value = 0;
  EXPECT_TRUE(record.read_mapping(1, value) == Abort::kNone);
  EXPECT_EQ(value, target);
}

TEST(PdoRecord, RefusesWhatCannotBeMapped) {
  PdoRecord<> record(Direction::kReceive, 0x205 | kPdoInvalid, 255, {});
  EXPECT_TRUE(record.write_mapping(1, 0x60640020, any_drive_object) == Abort::kNotMappable)
      << "what a drive sends is not received";
  EXPECT_TRUE(record.write_mapping(1, 0x607A0010, any_drive_object) == Abort::kNotMappable);
  EXPECT_TRUE(record.write_mapping(1, 0x55550008, any_drive_object) == Abort::kNoObject);
  EXPECT_TRUE(record.write_mapping(1, 0x60C20308, any_drive_object) == Abort::kNoSubindex);
  EXPECT_TRUE(record.write_mapping(9, 0x607A0020, any_drive_object) == Abort::kNoSubindex);
  EXPECT_TRUE(record.write_mapping(0, 1, any_drive_object) == Abort::kNotMappable) << "empty entry";
  for (std::uint8_t i = 1; i <= 3; ++i) {
    EXPECT_TRUE(record.write_mapping(i, 0x607A0020, any_drive_object) == Abort::kNone);
  }
  EXPECT_TRUE(record.write_mapping(0, 3, any_drive_object) == Abort::kPdoLength) << "96 bits";
  EXPECT_TRUE(record.write_mapping(0, 9, any_drive_object) == Abort::kPdoLength);
  EXPECT_EQ(record.mapping().count, 0);
  PdoRecord<> sent(Direction::kTransmit, 0x185 | kPdoInvalid, 1, {});
  EXPECT_TRUE(sent.write_mapping(1, kDummyU16.value(), any_drive_object) == Abort::kNotMappable)
      << "a TPDO has no dummies";
}

TEST(PdoRecord, RefusesIdentifiersAndTypesThatAreNotItsOwn) {
  PdoRecord<> record(Direction::kTransmit, 0x185, 1, {});
  EXPECT_TRUE(record.write_communication(1, 0x186) == Abort::kValueRange) << "it is on";
  EXPECT_TRUE(record.write_communication(1, 0x186 | kPdoInvalid) == Abort::kNone);
  EXPECT_TRUE(record.write_communication(1, 0x601) == Abort::kValueRange) << "SDO's";
  EXPECT_TRUE(record.write_communication(1, 0x186 | kPdoExtended) == Abort::kValueRange);
  EXPECT_TRUE(record.write_communication(2, 241) == Abort::kValueRange);
  EXPECT_TRUE(record.write_communication(2, 253) == Abort::kValueRange);
  EXPECT_TRUE(record.write_communication(2, 240) == Abort::kNone);
  EXPECT_TRUE(record.write_communication(4, 0) == Abort::kNoSubindex);
  EXPECT_TRUE(record.write_communication(6, 241) == Abort::kValueRange);
  EXPECT_TRUE(record.write_communication(6, 5) == Abort::kNone);
  EXPECT_TRUE(record.write_communication(1, 0x186) == Abort::kNone);
  EXPECT_TRUE(record.write_communication(6, 4) == Abort::kUnsupportedAccess) << "it is on";
  EXPECT_EQ(record.sync_start(), 5);
  EXPECT_EQ(record.id(), 0x186);
}

TEST(SyncSchedule, AnswersEveryNthSync) {
  SyncSchedule schedule;
  for (int sync = 1; sync <= 30; ++sync) {
    EXPECT_EQ(schedule.on_sync(3, 0, 0, false), sync % 3 == 0) << sync;
  }
  schedule.restart();
  EXPECT_FALSE(schedule.on_sync(kAcyclicSync, 0, 0, false));
  EXPECT_TRUE(schedule.on_sync(kAcyclicSync, 0, 0, true));
  EXPECT_FALSE(schedule.on_sync(kEventProfile, 0, 0, true)) << "not synchronous";
}

// 21 drives answer every fifth SYNC, at most five per SYNC.
TEST(SyncSchedule, StartValuesShareTheSyncs) {
  constexpr int kDrives = 21;
  SyncSchedule drives[kDrives];
  int answers[kDrives] = {};
  std::uint8_t counter = 3;
  for (int sync = 0; sync < 100; ++sync) {
    counter = counter == 5 ? std::uint8_t{1} : static_cast<std::uint8_t>(counter + 1);
    int together = 0;
    for (int i = 0; i < kDrives; ++i) {
      const auto start = static_cast<std::uint8_t>(1 + i % 5);
      if (!drives[i].on_sync(5, start, counter, false)) continue;
      ++together;
      ++answers[i];
      EXPECT_EQ(counter, start);
    }
    EXPECT_LE(together, 5);
    EXPECT_GE(together, 4);
  }
  for (const int each : answers) EXPECT_EQ(each, 20);
}

TEST(RpdoLatch, AppliesSynchronousDataWithTheNextSyncAndOnlyTheLatest) {
  RpdoLatch latch;
  Frame frame = classic_frame(0x201, 1);
  EXPECT_TRUE(latch.receive(kEventProfile, frame)) << "at once";
  EXPECT_FALSE(latch.on_sync(frame));
  for (std::uint8_t value = 1; value <= 2; ++value) {
    frame.data[0] = value;
    EXPECT_FALSE(latch.receive(1, frame));
  }
  Frame applied;
  EXPECT_TRUE(latch.on_sync(applied));
  EXPECT_EQ(applied.data[0], 2);
  EXPECT_FALSE(latch.on_sync(applied)) << "once";
}

}  // namespace
}  // namespace verp::canopen
