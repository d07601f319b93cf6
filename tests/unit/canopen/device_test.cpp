#include "common/protocol/canopen/device.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/canopen/drive_objects.hpp"
#include "common/protocol/canopen/sdo_client.hpp"

namespace verp::canopen {
namespace {

using cia402::DriveObjects;
namespace object = cia402::object;

struct Application402 {
  DriveObjects objects;
  Abort find(Address at, Entry& entry) { return cia402::find_object(at, entry); }
  Abort read(Address at, std::uint32_t, std::uint8_t* buffer, std::uint32_t) {
    return cia402::read_object(objects, at, buffer);
  }
  Abort write(Address at, const std::uint8_t* data, std::uint32_t) {
    return cia402::write_object(objects, at, data);
  }
  Abort mappable(Address at, std::uint8_t bits, bool receive) {
    return cia402::check_mappable(at, bits, receive);
  }
  std::uint64_t get(Address at, std::uint8_t bits) {
    std::uint8_t bytes[8] = {};
    cia402::read_object(objects, at, bytes);
    return get_le(bytes, bits / 8u);
  }
  void put(Address at, std::uint8_t bits, std::uint64_t value) {
    std::uint8_t bytes[8] = {};
    put_le(bytes, value, bits / 8u);
    cia402::write_object(objects, at, bytes);
  }
};

constexpr std::uint8_t kNode = 4;
constexpr DeviceSize kSize = {2, 2, 8, 1};

PdoMapping<> two(Address first, std::uint8_t first_bits, Address second, std::uint8_t second_bits) {
  PdoMapping<> mapping;
  mapping.add({first, first_bits});
  mapping.add({second, second_bits});
  return mapping;
}

struct Node {
  Application402 drive;
  Device<Application402, kSize> device{drive, {0x00020192, "verp drive", 1, 2, 3, 4}, kNode};
  SdoClient client{kNode};

  Node() {
    auto& objects = device.objects();
    objects.rpdos[0] = {Direction::kReceive, rpdo_id(1, kNode), 1,
                        two(object::kControlword, 16, object::kTargetPosition, 32)};
    objects.tpdos[0] = {Direction::kTransmit, tpdo_id(1, kNode), 1,
                        two(object::kStatusword, 16, object::kActualPosition, 32)};
    objects.rpdos[1] = {Direction::kReceive, rpdo_id(2, kNode) | kPdoInvalid, 255, {}};
    objects.tpdos[1] = {Direction::kTransmit, tpdo_id(2, kNode), 255,
                        two(object::kActualVelocity, 32, object::kActualTorque, 16)};
    device.start();
  }
  bool only(Frame& frame, std::uint64_t now_us = 0) {
    Frame more;
    return device.next(frame, now_us) && !device.next(more, now_us);
  }
  void operate() {
    Frame frame;
    while (device.next(frame, 0)) {
    }
    device.receive(nmt_frame(NmtCommand::kStart, 0), 0);
  }
  Abort write(Address at, std::uint32_t value, std::uint32_t bytes) {
    std::uint8_t data[4];
    put_le(data, value, 4);
    client.download(at, data, bytes, SdoClient::Mode::kPlain, 0);
    Frame frame;
    while (client.next(frame, 0)) device.receive(frame, 0);
    while (device.next(frame, 0)) client.receive(frame, 0);
    return client.state() == SdoClient::State::kDone ? Abort::kNone : client.reason();
  }
};

Frame command(std::uint16_t controlword, std::int32_t position) {
  Frame frame = classic_frame(rpdo_id(1, kNode), 6);
  put_le(frame.data, controlword, 2);
  put_le(frame.data + 2, static_cast<std::uint32_t>(position), 4);
  return frame;
}

TEST(Device, BootsAndTakesPdosOnlyWhenOperational) {
  Node node;
  Frame frame;
  EXPECT_TRUE(node.only(frame));
  EXPECT_EQ(frame.id, 0x704u);
  EXPECT_EQ(frame.data[0], 0) << "the boot-up message";
  node.device.receive(command(0xF, 100), 0);
  node.device.receive(classic_frame(kSyncId, 0), 0);
  EXPECT_FALSE(node.device.next(frame, 0)) << "no TPDO in pre-operational";
  EXPECT_EQ(node.drive.objects.target_position, 0);
  EXPECT_TRUE(node.device.receive(nmt_frame(NmtCommand::kStart, kNode), 0).nmt == NmtEvent::kState);
  EXPECT_FALSE(node.device.receive(command(0xF, 100), 0).put);
  EXPECT_EQ(node.drive.objects.target_position, 0) << "synchronous: not before the next SYNC";
  node.drive.objects.actual_position = 55;
  const DeviceEvents events = node.device.receive(classic_frame(kSyncId, 0), 0);
  EXPECT_TRUE(events.sync && events.put);
  EXPECT_EQ(node.drive.objects.target_position, 100);
  EXPECT_EQ(node.drive.objects.controlword, 0xF);
  node.drive.objects.actual_position = 66;
  EXPECT_TRUE(node.only(frame));
  EXPECT_EQ(frame.id, 0x184u);
  EXPECT_EQ(frame.size, 6);
  EXPECT_EQ(get_le(frame.data + 2, 4), 55u) << "what was true at the SYNC";
}

TEST(Device, SpeaksSdoUnlessStopped) {
  Node node;
  node.operate();
  EXPECT_TRUE(node.write(object::kHomeOffset, 7, 4) == Abort::kNone);
  EXPECT_EQ(node.drive.objects.home_offset, 7);
  node.device.receive(nmt_frame(NmtCommand::kStop, kNode), 0);
  node.write(object::kHomeOffset, 8, 4);
  EXPECT_EQ(node.drive.objects.home_offset, 7);
  EXPECT_TRUE(node.client.state() == SdoClient::State::kBusy) << "nobody answers";
}

// In the standard's order.
TEST(Device, IsRemappedThroughSdo) {
  Node node;
  node.operate();
  EXPECT_TRUE(node.write({0x1A00, 0}, 0, 1) == Abort::kUnsupportedAccess) << "the PDO is on";
  EXPECT_TRUE(node.write({0x1800, 1}, 0x80000184, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1A00, 0}, 0, 1) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1A00, 1}, 0x60770010, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1A00, 2}, 0x607A0020, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1A00, 3}, 0x605A0010, 4) == Abort::kNotMappable);
  EXPECT_TRUE(node.write({0x1A00, 0}, 1, 1) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 1}, 0x00000184, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1A02, 0}, 0, 1) == Abort::kNoObject) << "no such PDO";
  node.drive.objects.actual_torque = -3;
  node.device.receive(classic_frame(kSyncId, 0), 0);
  Frame frame;
  EXPECT_TRUE(node.only(frame));
  EXPECT_EQ(frame.size, 2);
  EXPECT_EQ(get_le(frame.data, 2), 0xFFFDu);
}

// CiA 301.
TEST(Device, WaitsForItsSyncStartValueAgainWhenItsPdoIsSwitchedOffAndOn) {
  Node node;
  constexpr std::uint8_t kGroups = 3, kStart = 2;
  EXPECT_TRUE(node.write({0x1019, 0}, kGroups, 1) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 1}, 0x80000184, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 2}, kGroups, 1) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 6}, kStart, 1) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 1}, 0x00000184, 4) == Abort::kNone);
  node.operate();
  const auto answers = [&](int counter) {
    Frame sync = classic_frame(kSyncId, 1), frame;
    sync.data[0] = static_cast<std::uint8_t>(counter);
    node.device.receive(sync, 0);
    return node.device.next(frame, 0);
  };
  for (int counter = 1; counter <= kGroups; ++counter) {
    EXPECT_EQ(answers(counter), counter == kStart);
  }
  answers(1);
  for (int counter = 3; counter <= kGroups; ++counter) answers(counter);
  for (int counter = 1; counter <= kGroups; ++counter) {
    EXPECT_EQ(answers(counter), counter == kStart + 1) << "astray";
  }
  EXPECT_TRUE(node.write({0x1800, 1}, 0x80000184, 4) == Abort::kNone);
  EXPECT_TRUE(node.write({0x1800, 1}, 0x00000184, 4) == Abort::kNone);
  for (int tick = 0; tick < 3; ++tick) {
    for (int counter = 1; counter <= kGroups; ++counter) {
      EXPECT_EQ(answers(counter), counter == kStart);
    }
  }
}

TEST(Device, TellsWhoItIs) {
  Node node;
  node.operate();
  std::uint8_t text[16] = {};
  node.client.upload({0x1008, 0}, text, sizeof text, SdoClient::Mode::kPlain, 0);
  Frame frame;
  for (int i = 0; i < 10; ++i) {
    while (node.client.next(frame, 0)) node.device.receive(frame, 0);
    while (node.device.next(frame, 0)) node.client.receive(frame, 0);
  }
  EXPECT_EQ(node.client.size(), 10u);
  EXPECT_STREQ(reinterpret_cast<const char*>(text), "verp drive");
  struct Row {
    Address at;
    std::uint32_t value;
  };
  for (const Row& row : {Row{{0x1000, 0}, 0x20192}, Row{{0x1001, 0}, 0}, Row{{0x1005, 0}, 0x80},
                         Row{{0x1014, 0}, 0x84}, Row{{0x1018, 0}, 4}, Row{{0x1018, 3}, 3},
                         Row{{0x1400, 1}, 0x40000204}, Row{{0x1600, 2}, 0x607A0020},
                         Row{{0x1800, 0}, 6}, Row{{0x1400, 0}, 5}, Row{{0x1016, 0}, 1}}) {
    Entry entry;
    EXPECT_TRUE(node.device.objects().find(row.at, entry) == Abort::kNone);
    std::uint8_t bytes[4] = {};
    EXPECT_TRUE(node.device.objects().read(row.at, 0, bytes, entry.size) == Abort::kNone);
    EXPECT_EQ(get_le(bytes, 4), row.value) << row.at.index;
    EXPECT_FALSE(entry.writable && row.at.index < 0x1400);
  }
}

TEST(Device, SendsEventsNoOftenerThanItsInhibitTimeAndNoRarerThanItsTimer) {
  Node node;
  auto& record = node.device.objects().tpdos[1];
  record.write_communication(1, 0x80000284);
  record.write_communication(3, 50);   // 5 ms
  record.write_communication(5, 100);  // ms
  record.write_communication(1, 0x284);
  node.operate();
  Frame frame;
  EXPECT_TRUE(node.only(frame, 1000));
  EXPECT_EQ(frame.id, 0x284u);
  node.device.trigger(1);
  EXPECT_FALSE(node.device.next(frame, 5999));
  EXPECT_TRUE(node.only(frame, 6000));
  EXPECT_FALSE(node.device.next(frame, 105'999));
  EXPECT_TRUE(node.only(frame, 106'000));
}

TEST(Device, ReportsWhatIsWrongOnTheBus) {
  Node node;
  node.operate();
  Frame frame;
  node.device.receive(classic_frame(kSyncId, 1), 0);  // 1019h is 0
  EXPECT_TRUE(node.device.next(frame, 0));
  Emergency emergency;
  EXPECT_TRUE(decode_emcy(frame, emergency));
  EXPECT_EQ(emergency.code, 0x8240);
  EXPECT_EQ(emergency.error_register, kErrorGeneric | kErrorCommunication);
  EXPECT_TRUE(node.only(frame)) << "it counts as a SYNC all the same";
  EXPECT_EQ(frame.id, 0x184u);
  Frame half = command(0xF, 100);
  half.size = 5;
  node.device.receive(half, 0);
  node.device.receive(classic_frame(kSyncId, 0), 0);
  EXPECT_TRUE(node.device.next(frame, 0));
  EXPECT_TRUE(decode_emcy(frame, emergency));
  EXPECT_EQ(emergency.code, 0) << "SYNCs are well again";
  EXPECT_TRUE(node.device.next(frame, 0));
  EXPECT_TRUE(decode_emcy(frame, emergency));
  EXPECT_EQ(emergency.code, 0x8210);
  EXPECT_EQ(node.drive.objects.controlword, 0) << "not even the part that is there";
  std::uint32_t newest = 0;
  EXPECT_TRUE(node.device.objects().history.read(1, newest) == Abort::kNone);
  EXPECT_EQ(newest, 0x8210u);
}

// Each tick brings a wrong SYNC to every node: an EMCY each would fill the bus.
TEST(Device, SaysOnceThatTheCommunicationIsWrongAndOnceThatItIsWell) {
  Node node;
  node.operate();
  Frame frame;
  Emergency emergency;
  int said = 0;
  for (int i = 0; i < 20; ++i) {
    node.device.receive(classic_frame(kSyncId, i < 10 ? 1 : 0), 0);  // 1019h is 0
    while (node.device.next(frame, 0)) {
      if (!decode_emcy(frame, emergency)) continue;
      ++said;
      EXPECT_EQ(emergency.code, i < 10 ? 0x8240 : 0);
      EXPECT_EQ(emergency.error_register, i < 10 ? kErrorGeneric | kErrorCommunication : 0);
    }
  }
  EXPECT_EQ(said, 2);
  node.device.receive(classic_frame(kSyncId, 1), 0);
  node.device.report(ErrorCode::kOverTemperature, kErrorTemperature);
  node.device.receive(classic_frame(kSyncId, 0), 0);
  EXPECT_EQ(node.device.objects().error_register, kErrorGeneric | kErrorTemperature);
  node.device.receive(classic_frame(kSyncId, 1), 0);
  node.device.report(ErrorCode::kNoError, 0);
  EXPECT_EQ(node.device.objects().error_register, kErrorGeneric | kErrorCommunication);
}

TEST(Device, NoticesAMasterThatFallsSilent) {
  Node node;
  node.operate();
  EXPECT_TRUE(node.write({0x1016, 1}, 0x007F0032, 4) == Abort::kNone);
  EXPECT_FALSE(node.device.heartbeat_lost(1'000'000)) << "not before its first heartbeat";
  node.device.receive(heartbeat_frame(127, NmtState::kOperational), 1'000'000);
  EXPECT_FALSE(node.device.heartbeat_lost(1'049'999));
  EXPECT_TRUE(node.device.heartbeat_lost(1'050'000));
  EXPECT_FALSE(node.device.heartbeat_lost(1'050'000)) << "told once";
  Frame frame;
  EXPECT_TRUE(node.only(frame));
  Emergency emergency;
  EXPECT_TRUE(decode_emcy(frame, emergency));
  EXPECT_EQ(emergency.code, 0x8130);
}

TEST(Device, ForgetsTheSilentMasterWhenItIsWatchedNoLonger) {
  Node node;
  node.operate();
  EXPECT_TRUE(node.write({0x1016, 1}, 0x007F0032, 4) == Abort::kNone);
  node.device.receive(heartbeat_frame(127, NmtState::kOperational), 1'000'000);
  ASSERT_TRUE(node.device.heartbeat_lost(1'050'000));
  EXPECT_TRUE(node.device.standing_error() == ErrorCode::kHeartbeatLost);
  EXPECT_NE(node.device.objects().error_register, 0);
  EXPECT_TRUE(node.write({0x1016, 1}, 0, 4) == Abort::kNone);
  EXPECT_TRUE(node.device.standing_error() == ErrorCode::kNoError);
  EXPECT_EQ(node.device.objects().error_register, 0);
}

TEST(Device, ForgetsWhatWaitedForASyncWhenItLeavesOperational) {
  Node node;
  node.operate();
  node.device.receive(command(0xF, 100), 0);
  node.device.receive(nmt_frame(NmtCommand::kEnterPreOperational, kNode), 0);
  node.device.receive(nmt_frame(NmtCommand::kStart, kNode), 0);
  EXPECT_FALSE(node.device.receive(classic_frame(kSyncId, 0), 0).put);
  EXPECT_EQ(node.drive.objects.controlword, 0);
}

TEST(Device, BootsAgainAfterAResetAndDropsWhatWasUnderWay) {
  Node node;
  node.operate();
  node.device.receive(command(0xF, 100), 0);
  EXPECT_TRUE(node.device.receive(nmt_frame(NmtCommand::kResetCommunication, kNode), 0).nmt ==
              NmtEvent::kResetCommunication);
  Frame frame;
  EXPECT_FALSE(node.device.receive(classic_frame(kSyncId, 0), 0).sync) << "initialising";
  node.device.start();
  EXPECT_TRUE(node.only(frame));
  EXPECT_EQ(frame.data[0], 0);
  node.device.receive(nmt_frame(NmtCommand::kStart, kNode), 0);
  node.device.receive(classic_frame(kSyncId, 0), 0);
  EXPECT_EQ(node.drive.objects.controlword, 0) << "an RPDO of before the reset";
}

}  // namespace
}  // namespace verp::canopen
