#include "firmware/app/feetech_master.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/model/params.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/plausible_counts.hpp"
#include "firmware/app/serial_servos.hpp"
#include "hal/fake/scripted_bus.hpp"

namespace verp::app {
namespace {

TEST(FeetechMaster, AnEchoOfItsOwnRequestIsAStrayAndNoAnswer) {
  static hal::ScriptedBus bus;
  static FeetechMaster master(bus);
  std::uint8_t request[16], replies[32];
  // Two bytes at 56: the echo looks like an answer of id 1 with two bytes.
  const std::size_t size =
      feetech::encode_read(request, sizeof request, 1, feetech::address::kPresentPosition, 2);
  for (std::size_t i = 0; i < size; ++i) replies[i] = request[i];
  constexpr std::uint8_t kData[] = {0x18, 0x05};
  const std::size_t more =
      feetech::encode_status(replies + size, sizeof replies - size, 1, 0, kData, sizeof kData);
  bus.expect(request, size, replies, size + more, 100);
  for (std::size_t i = 0; i < size; ++i) master.frame()[i] = request[i];
  int position = -1;
  EXPECT_TRUE(master.request(size, 1000, [&](const feetech::Packet& packet) {
    position = feetech::get_u16(packet.parameters);
    return Take::kDone;
  }));
  EXPECT_EQ(position, 1304);
  EXPECT_EQ(master.counters().strays, 1u);
}

// A board that refuses to start sends it.
TEST(SerialServos, TorqueOffIsInTheWordsOfTheFamily) {
  const auto sent = [](BusProtocol protocol) {
    std::uint8_t frame[32];
    const std::size_t size = encode_torque_off(frame, sizeof frame, protocol);
    return std::vector<std::uint8_t>(frame, frame + size);
  };
  const std::vector<std::uint8_t> feetech = {0xFF, 0xFF, 0xFE, 0x04, 0x03, 0x28, 0x00, 0xD2};
  EXPECT_EQ(sent(BusProtocol::kFeetech), feetech);
  const std::vector<std::uint8_t> dynamixel = sent(BusProtocol::kDynamixel2);
  ASSERT_EQ(dynamixel.size(), 13u);
  EXPECT_EQ(dynamixel[4], dxl::kBroadcast);
  EXPECT_EQ(dynamixel[8], 64) << "e-Manual: Torque Enable";
}

TEST(PlausibleCounts, AJumpCountsOnlyIfTheNextReadingConfirmsIt) {
  static Params params;
  params.joint[0].counts_per_rad = -651.9F;
  params.joint[0].velocity_limit_rad_s = 6;  // 39 counts in 10 ms
  PlausibleCounts filter(params);
  EXPECT_TRUE(filter.counts(0, 3000, 1)) << "the first";
  EXPECT_TRUE(filter.counts(0, 3100, 1));
  EXPECT_FALSE(filter.counts(0, 1000, 1)) << "damaged";
  EXPECT_TRUE(filter.counts(0, 3110, 2));
  EXPECT_FALSE(filter.counts(0, 500, 1));
  EXPECT_TRUE(filter.counts(0, 510, 2)) << "turned by hand";
  EXPECT_FALSE(filter.counts(0, 2000, 1));
  EXPECT_TRUE(filter.counts(0, 2000, 50)) << "after a silence it may be anywhere near";
}

}  // namespace
}  // namespace verp::app
