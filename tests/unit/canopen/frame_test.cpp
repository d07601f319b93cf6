#include "common/protocol/canopen/frame.hpp"

#include <gtest/gtest.h>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/emcy.hpp"
#include "common/protocol/canopen/sync.hpp"

namespace verp::canopen {
namespace {

TEST(Frame, LittleEndianNumbersComeBack) {
  std::uint64_t value = 0x0123456789ABCDEF;
  for (unsigned bytes = 1; bytes <= 8; ++bytes) {
    std::uint8_t buffer[9] = {};
    buffer[bytes] = 0xA5;
    put_le(buffer, value, bytes);
    const std::uint64_t kept = bytes == 8 ? value : value & ((std::uint64_t{1} << 8 * bytes) - 1);
    EXPECT_EQ(get_le(buffer, bytes), kept);
    EXPECT_EQ(buffer[0], 0xEF);
    EXPECT_EQ(buffer[bytes], 0xA5) << "nothing is written behind the number";
  }
}

// ISO 11898-1's data length codes.
TEST(Frame, FdSizesAreThoseWithACode) {
  const std::uint8_t sizes[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  for (std::uint8_t code = 0; code < 16; ++code) {
    EXPECT_EQ(can_fd_size(sizes[code]), sizes[code]);
    EXPECT_EQ(can_length_code(sizes[code]), code);
  }
  for (std::size_t size = 0; size <= 64; ++size) {
    EXPECT_GE(can_fd_size(size), size);
    EXPECT_EQ(can_fd_size(can_fd_size(size)), can_fd_size(size));
  }
  EXPECT_EQ(can_fd_size(9), 12);
  EXPECT_EQ(can_fd_size(49), 64);
}

// First and last of CiA 301.
TEST(CobId, IsThatOfThePredefinedConnectionSet) {
  EXPECT_EQ(emcy_id(1), 0x081);
  EXPECT_EQ(emcy_id(127), 0x0FF);
  EXPECT_EQ(tpdo_id(1, 1), 0x181);
  EXPECT_EQ(rpdo_id(1, 127), 0x27F);
  EXPECT_EQ(tpdo_id(2, 1), 0x281);
  EXPECT_EQ(rpdo_id(2, 1), 0x301);
  EXPECT_EQ(tpdo_id(3, 1), 0x381);
  EXPECT_EQ(rpdo_id(3, 1), 0x401);
  EXPECT_EQ(tpdo_id(4, 1), 0x481);
  EXPECT_EQ(rpdo_id(4, 127), 0x57F);
  EXPECT_EQ(sdo_response_id(1), 0x581);
  EXPECT_EQ(sdo_request_id(127), 0x67F);
  EXPECT_EQ(heartbeat_id(1), 0x701);
}

TEST(CobId, EveryIdentifierLeadsBackToItsService) {
  for (unsigned i = 1; i <= kMaxNode; ++i) {
    const auto node = static_cast<std::uint8_t>(i);
    EXPECT_TRUE((connection_of(emcy_id(node)) == Connection{Service::kEmcy, node}));
    EXPECT_TRUE((connection_of(sdo_request_id(node)) == Connection{Service::kSdoRequest, node}));
    EXPECT_TRUE((connection_of(sdo_response_id(node)) == Connection{Service::kSdoResponse, node}));
    EXPECT_TRUE((connection_of(heartbeat_id(node)) == Connection{Service::kHeartbeat, node}));
    for (std::uint8_t number = 1; number <= kPdosOfSet; ++number) {
      EXPECT_TRUE(
          (connection_of(tpdo_id(number, node)) == Connection{Service::kTpdo, node, number}));
      EXPECT_TRUE(
          (connection_of(rpdo_id(number, node)) == Connection{Service::kRpdo, node, number}));
    }
  }
  EXPECT_TRUE(connection_of(0x000).service == Service::kNmt);
  EXPECT_TRUE(connection_of(0x080).service == Service::kSync);
  EXPECT_TRUE(connection_of(0x100).service == Service::kTime);
  EXPECT_TRUE(connection_of(0x101).service == Service::kOther);
  EXPECT_TRUE(connection_of(0x680).service == Service::kOther);
  EXPECT_TRUE(connection_of(0x6E1).service == Service::kOther);
  EXPECT_TRUE(connection_of(0x7E5).service == Service::kOther);
}

// PDOs may not use those of NMT, SDO or heartbeat.
TEST(CobId, RestrictedIdentifiersAreThoseOfTheFixedServices) {
  for (unsigned i = 1; i <= kMaxNode; ++i) {
    const auto node = static_cast<std::uint8_t>(i);
    EXPECT_TRUE(is_restricted(sdo_request_id(node)));
    EXPECT_TRUE(is_restricted(sdo_response_id(node)));
    EXPECT_TRUE(is_restricted(heartbeat_id(node)));
    EXPECT_FALSE(is_restricted(emcy_id(node)));
    for (std::uint8_t number = 1; number <= kPdosOfSet; ++number) {
      EXPECT_FALSE(is_restricted(tpdo_id(number, node)));
      EXPECT_FALSE(is_restricted(rpdo_id(number, node)));
    }
  }
  EXPECT_TRUE(is_restricted(kNmtId));
  EXPECT_FALSE(is_restricted(kSyncId));
}

TEST(Sync, CarriesItsCounterOrNothing) {
  EXPECT_EQ(sync_frame(0).size, 0) << "without a counter";
  for (std::uint8_t wanted = 1; wanted <= kMaxSyncCounter; ++wanted) {
    std::uint8_t counter = 0;
    EXPECT_TRUE(read_sync(sync_frame(wanted), 240, counter) == SyncSeen::kSync);
    EXPECT_EQ(counter, wanted);
  }
}

TEST(Sync, OverflowsAreNoneOrTwoTo240) {
  for (unsigned overflow = 0; overflow < 256; ++overflow) {
    const bool fine = overflow == 0 || (overflow >= 2 && overflow <= 240);
    EXPECT_TRUE(check_sync_overflow(static_cast<std::uint8_t>(overflow)) ==
                (fine ? Abort::kNone : Abort::kValueRange))
        << overflow;
  }
}

TEST(Sync, OfAnotherLengthIsTold) {
  std::uint8_t counter = 7;
  EXPECT_TRUE(read_sync(classic_frame(kSyncId, 1), 0, counter) == SyncSeen::kWrongLength);
  EXPECT_EQ(counter, 0);
  EXPECT_TRUE(read_sync(classic_frame(kSyncId, 0), 5, counter) == SyncSeen::kWrongLength);
  EXPECT_TRUE(read_sync(classic_frame(kSyncId, 0), 0, counter) == SyncSeen::kSync);
  EXPECT_TRUE(read_sync(classic_frame(0x081, 0), 0, counter) == SyncSeen::kNo);
  Frame remote = classic_frame(kSyncId, 0);
  remote.remote = true;
  EXPECT_TRUE(read_sync(remote, 0, counter) == SyncSeen::kNo);
}

TEST(Emergency, HasTheStandardsLayoutAndComesBack) {
  const Emergency sent = {5, 0x8611, kErrorGeneric | kErrorProfile, {1, 2, 3, 4, 5}};
  const Frame frame = encode_emcy(sent);
  EXPECT_EQ(frame.id, 0x085u);
  EXPECT_EQ(frame.size, 8);
  const std::uint8_t bytes[] = {0x11, 0x86, 0x21, 1, 2, 3, 4, 5};
  for (unsigned i = 0; i < 8; ++i) EXPECT_EQ(frame.data[i], bytes[i]);
  Emergency received;
  EXPECT_TRUE(decode_emcy(frame, received));
  EXPECT_TRUE(received == sent);
  Frame sync = classic_frame(kSyncId, 8);
  EXPECT_FALSE(decode_emcy(sync, received)) << "SYNC's identifier is EMCY's of no node";
  EXPECT_FALSE(decode_emcy(classic_frame(0x085, 7), received));
}

TEST(ErrorHistory, KeepsTheNewestFirstAndForgetsOnZero) {
  ErrorHistory<3> history;
  std::uint32_t value = 9;
  EXPECT_TRUE(history.read(0, value) == Abort::kNone);
  EXPECT_EQ(value, 0u);
  EXPECT_TRUE(history.read(1, value) == Abort::kNoData);
  for (std::uint32_t error = 1; error <= 5; ++error) history.push(error);
  for (std::uint8_t i = 1; i <= 3; ++i) {
    EXPECT_TRUE(history.read(i, value) == Abort::kNone);
    EXPECT_EQ(value, 6u - i);
  }
  EXPECT_TRUE(history.read(4, value) == Abort::kNoSubindex);
  EXPECT_TRUE(history.write(0, 1) == Abort::kValueRange);
  EXPECT_TRUE(history.write(1, 0) == Abort::kReadOnly);
  EXPECT_EQ(history.count(), 3);
  EXPECT_TRUE(history.write(0, 0) == Abort::kNone);
  EXPECT_EQ(history.count(), 0);
}

}  // namespace
}  // namespace verp::canopen
