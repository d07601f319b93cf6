#include "host/twin/can/other_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "common/protocol/canopen/robot_plan.hpp"
#include "tests/host/can/can_bench.hpp"

namespace verp::can {
namespace {

class OtherNodesTest : public ::testing::Test {
 protected:
  void hear(std::uint32_t id, std::uint8_t size, int times) {
    for (int i = 0; i < times; ++i) others.take(canopen::classic_frame(id, size));
  }
  const Params params = test::can_params(21);
  OtherNodes others{params};
};

TEST_F(OtherNodesTest, WhatANodeSendsAgainAndAgainIsProof) {
  const std::uint8_t drive = params.joint[4].servo_id, imu = params.imu.device_id;
  const struct {
    std::uint32_t id;
    std::uint8_t size, node;
  } kSigns[] = {{canopen::heartbeat_id(drive), 1, drive},
                {canopen::sdo_response_id(drive), 8, drive},
                {canopen::tpdo_id(1, drive), canopen::plan::kDriveAnswerBytes, drive},
                {canopen::tpdo_id(2, imu), canopen::plan::kImuAnswerBytes, imu}};
  for (const auto& sign : kSigns) {
    others = OtherNodes(params);
    hear(sign.id, sign.size, 4);
    EXPECT_EQ(others.found(), 0) << sign.id;
    hear(sign.id, sign.size, 1);
    EXPECT_EQ(others.found(), sign.node) << sign.id;
  }
}

TEST_F(OtherNodesTest, WhatAMasterOrAnotherRobotSendsIsNone) {
  const std::uint8_t drive = params.joint[4].servo_id;
  hear(canopen::kSyncId, 1, 100);
  hear(canopen::kNmtId, 2, 100);
  hear(canopen::sdo_request_id(drive), 8, 100);
  for (unsigned number = 1; number <= 4; ++number) hear(canopen::rpdo_id(number, drive), 8, 100);
  hear(canopen::heartbeat_id(canopen::plan::kControllerNode), 1, 100);
  hear(canopen::tpdo_id(1, canopen::plan::kControllerNode), 8, 100);
  hear(canopen::heartbeat_id(120), 1, 100);
  EXPECT_EQ(others.found(), 0);
}

// cangen's frames: half have eight bytes, like most answers.
TEST_F(OtherNodesTest, AFewRandomFramesAreNone) {
  std::mt19937 random(1);
  for (int run = 0; run < 10'000; ++run) {
    others = OtherNodes(params);
    for (int i = 0; i < 300; ++i) {
      hear(random() % 0x800, std::min<std::uint8_t>(random() % 16, kMaxCanData), 1);
    }
    ASSERT_EQ(others.found(), 0) << "run " << run;
  }
}

}  // namespace
}  // namespace verp::can
