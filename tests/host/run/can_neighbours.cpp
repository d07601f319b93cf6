#include "host/apps/tool/robot/can_neighbours.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/sync.hpp"

// `verp run` over CAN names other programs and devices.
namespace verp::tool {
namespace {

Params three_joints() {
  Params params;
  params.joint_count = 3;
  for (int joint = 0; joint < 3; ++joint) {
    params.joint[joint].servo_id = static_cast<std::uint8_t>(11 + joint);
  }
  std::snprintf(params.joint[1].name, sizeof params.joint[1].name, "left_knee");
  return params;
}

struct Bus {
  /// Each drive answers SYNC 1; drive 12 so many times.
  std::string tick(int answers = 1) {
    neighbours.sent(canopen::sync_frame(1));
    neighbours.sent(canopen::sync_frame(2));
    for (std::uint8_t node = 11; node <= 13; ++node) {
      for (int i = 0; i < (node == 12 ? answers : 1); ++i) {
        neighbours.came(canopen::classic_frame(canopen::tpdo_id(1, node), 6));
      }
    }
    return neighbours.news();
  }
  void boot(std::uint8_t node) {
    neighbours.came(canopen::classic_frame(canopen::heartbeat_id(node), 1));
  }

  Params params = three_joints();
  CanNeighbours neighbours{params};
};

TEST(CanNeighbours, ALateAnswerOrTwoIsNoNeighbour) {
  Bus bus;
  for (int tick = 0; tick < 1000; ++tick) ASSERT_EQ(bus.tick(tick % 100 == 0 ? 2 : 1), "");
}

TEST(CanNeighbours, ADriveThatBootsIsNoNeighbour) {
  Bus bus;
  for (int tick = 0; tick < 10; ++tick) bus.tick();
  bus.boot(12);
  for (int tick = 0; tick < 20; ++tick) ASSERT_EQ(bus.tick(0), "");
  for (int tick = 0; tick < 20; ++tick) ASSERT_EQ(bus.tick(), "");
}

TEST(CanNeighbours, AProgramThatBootsWithADrivesNodeIdIsNamedOnce) {
  Bus bus;
  bus.tick();
  bus.boot(12);
  EXPECT_EQ(bus.tick(),
            "another device or program has node id 12 (left_knee): end it, or change its id");
  bus.boot(12);
  EXPECT_EQ(bus.tick(), "");
}

TEST(CanNeighbours, ANodeIdThatAnswersTwiceInEachTickIsNamed) {
  Bus bus;
  std::string news;
  for (int tick = 0; tick < 100 && news.empty(); ++tick) news = bus.tick(2);
  EXPECT_NE(news.find("node id 12 (left_knee)"), std::string::npos) << news;
}

TEST(CanNeighbours, AnotherMasterIsNamed) {
  Bus bus;
  bus.tick();
  bus.neighbours.came(canopen::classic_frame(canopen::rpdo_id(1, 13), 6));
  EXPECT_EQ(bus.neighbours.news(),
            "another program talks as a master on this bus (identifier 0x20D): end it");
  bus.neighbours.came(canopen::sync_frame(1));
  EXPECT_EQ(bus.neighbours.news(), "") << "said once";
}

}  // namespace
}  // namespace verp::tool
