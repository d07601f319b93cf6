#include "common/protocol/canopen/drive_objects.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "common/protocol/canopen/sdo_server.hpp"

namespace verp::canopen::cia402 {
namespace {

TEST(DriveObjects, EveryRowIsFoundReadAndRefusedIfReadOnly) {
  DriveObjects objects;
  EXPECT_GT(kDriveRowCount, 10u);
  for (std::size_t i = 0; i < kDriveRowCount; ++i) {
    const ObjectRow& row = kDriveRows[i];
    EXPECT_TRUE(find_row(row.at) == &row) << "one row an address: " << row.name;
    Entry entry;
    EXPECT_TRUE(find_object(row.at, entry) == Abort::kNone);
    EXPECT_EQ(entry.size, row.bytes);
    std::uint8_t bytes[4] = {};
    EXPECT_TRUE(read_object(objects, row.at, bytes) == Abort::kNone);
    const Abort written = write_object(objects, row.at, bytes);
    EXPECT_TRUE(written == (entry.writable ? Abort::kNone : Abort::kReadOnly)) << row.name;
  }
}

TEST(DriveObjects, NoTwoRowsShareBytes) {
  for (std::size_t i = 0; i < kDriveRowCount; ++i) {
    for (std::size_t k = i + 1; k < kDriveRowCount; ++k) {
      const ObjectRow& a = kDriveRows[i];
      const ObjectRow& b = kDriveRows[k];
      EXPECT_TRUE(a.place + a.bytes <= b.place || b.place + b.bytes <= a.place) << a.name;
      EXPECT_FALSE(a.at == b.at);
    }
  }
}

TEST(DriveObjects, ValuesAreLittleEndianAndOfTheRightMember) {
  DriveObjects objects;
  std::uint8_t bytes[4] = {0x78, 0x56, 0x34, 0x12};
  EXPECT_TRUE(write_object(objects, object::kTargetPosition, bytes) == Abort::kNone);
  EXPECT_EQ(objects.target_position, 0x12345678);
  objects.actual_position = -2;
  EXPECT_TRUE(read_object(objects, object::kActualPosition, bytes) == Abort::kNone);
  EXPECT_EQ(get_le(bytes, 4), 0xFFFFFFFEu);
  EXPECT_TRUE(read_object(objects, {0x60C2, 0}, bytes) == Abort::kNone);
  EXPECT_EQ(bytes[0], 2) << "subindex 0 gives the highest";
  EXPECT_TRUE(read_object(objects, {0x60C2, 3}, bytes) == Abort::kNoSubindex);
  EXPECT_TRUE(read_object(objects, {0x607A, 1}, bytes) == Abort::kNoSubindex);
  EXPECT_TRUE(read_object(objects, {0x6098, 0}, bytes) == Abort::kNoObject);
}

TEST(DriveObjects, RefuseValuesThatMeanNothing) {
  DriveObjects objects;
  const std::uint8_t profile_position = 1;
  const std::uint8_t cyclic_position = 8;
  EXPECT_TRUE(write_object(objects, object::kMode, &profile_position) == Abort::kValueRange);
  EXPECT_TRUE(write_object(objects, object::kMode, &cyclic_position) == Abort::kNone);
  EXPECT_EQ(objects.mode, kModeCyclicPosition);
  const std::uint8_t four[2] = {4, 0};
  EXPECT_TRUE(write_object(objects, object::kAbortConnection, four) == Abort::kValueRange);
  EXPECT_TRUE(write_object(objects, object::kQuickStopOption, four) == Abort::kValueRange);
  const std::uint8_t zero = 0;
  EXPECT_TRUE(write_object(objects, object::kPeriodValue, &zero) == Abort::kValueRange);
  EXPECT_EQ(objects.period_value, 1) << "what is refused changes nothing";
}

TEST(DriveObjects, InterpolationPeriodIsValueTimesTenToTheExponent) {
  EXPECT_EQ(interpolation_period_us(8, -3), 8000u);
  EXPECT_EQ(interpolation_period_us(5, -3), 5000u);
  EXPECT_EQ(interpolation_period_us(80, -4), 8000u);
  EXPECT_EQ(interpolation_period_us(250, -6), 250u);
  EXPECT_EQ(interpolation_period_us(1, 0), 1'000'000u);
  EXPECT_EQ(interpolation_period_us(1, -7), 0u);
  EXPECT_EQ(interpolation_period_us(255, 1), 0u);
}

TEST(FollowingMonitor, TellsADistanceThatLastsLongerThanAllowed) {
  DriveObjects objects;
  FollowingMonitor monitor;
  objects.target_position = INT32_MAX;
  objects.actual_position = INT32_MIN;
  EXPECT_FALSE(monitor.update(objects, 1'000'000)) << "the default window watches nothing";
  objects.following_window = 100;
  objects.following_time_ms = 10;
  objects.actual_position = objects.target_position - 100;
  EXPECT_FALSE(monitor.update(objects, 2'000'000)) << "inside";
  objects.actual_position -= 1;
  EXPECT_FALSE(monitor.update(objects, 3'000'000));
  EXPECT_FALSE(monitor.update(objects, 3'009'999));
  EXPECT_TRUE(monitor.update(objects, 3'010'000));
  objects.actual_position += 1;
  EXPECT_FALSE(monitor.update(objects, 3'011'000));
  objects.actual_position = INT32_MIN;
  EXPECT_FALSE(monitor.update(objects, 3'012'000)) << "its time begins anew";
}

struct DriveDictionary {
  DriveObjects objects;
  Abort find(Address at, Entry& entry) { return find_object(at, entry); }
  Abort read(Address at, std::uint32_t, std::uint8_t* buffer, std::uint32_t) {
    return read_object(objects, at, buffer);
  }
  Abort write(Address at, const std::uint8_t* data, std::uint32_t) {
    return write_object(objects, at, data);
  }
};

TEST(DriveObjects, AreServedBySdo) {
  DriveDictionary drive;
  SdoServer<DriveDictionary, 8> server(drive, 7);
  SdoClient client(7);
  std::uint8_t bytes[4] = {0x11, 0x22, 0x33, 0x44};
  Frame frame;
  client.download(object::kTargetPosition, bytes, 4, SdoClient::Mode::kPlain, 0);
  while (client.next(frame, 0)) server.receive(frame, 0);
  while (server.next(frame, 0)) client.receive(frame, 0);
  EXPECT_TRUE(client.state() == SdoClient::State::kDone);
  EXPECT_EQ(drive.objects.target_position, 0x44332211);
  client.download(object::kStatusword, bytes, 2, SdoClient::Mode::kPlain, 0);
  while (client.next(frame, 0)) server.receive(frame, 0);
  while (server.next(frame, 0)) client.receive(frame, 0);
  EXPECT_TRUE(client.reason() == Abort::kReadOnly);
}

}  // namespace
}  // namespace verp::canopen::cia402
