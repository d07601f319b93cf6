#include "common/protocol/canopen/robot_plan.hpp"

#include <gtest/gtest.h>

namespace verp::canopen::plan {
namespace {

Params robot(int joints, bool sensors) {
  Params params;
  params.joint_count = static_cast<std::uint8_t>(joints);
  for (int j = 0; j < joints; ++j) params.joint[j].servo_id = static_cast<std::uint8_t>(40 - j);
  if (!sensors) return params;
  params.imu.device_id = 120;
  params.feet.device_id[0] = 121;
  params.feet.device_id[1] = 122;
  return params;
}

// A receiver may have room for five.
TEST(RobotPlan, AtMostFiveFramesAnswerOneSync) {
  for (int joints = 0; joints <= kMaxJoints; ++joints) {
    for (const bool sensors : {false, true}) {
      const Params params = robot(joints, sensors);
      const int groups = sync_groups(params);
      int answers[16] = {};
      for (int j = 0; j < joints; ++j) ++answers[group_of_joint(j)];
      answers[groups] += sensor_answers(params);
      EXPECT_EQ(answers[0], 0);
      for (int g = 1; g < 16; ++g) EXPECT_LE(answers[g], g <= groups ? kAnswersToOneSync : 0);
      EXPECT_GE(groups, 2) << "1019h does not know 1";
    }
  }
}
TEST(RobotPlan, TwentyOneDrivesWithSensorsTakeFiveSyncs) {
  EXPECT_EQ(sync_groups(robot(21, true)), 5);
}

TEST(RobotPlan, DrivesOfASharedFrameMapDisjointPlaces) {
  const Params params = robot(21, true);
  for (const Shared& kind : {kGoals, kWords, kStrengths}) {
    int told = 0;
    for (int frame = 0; frame < shared_frames(kind, params); ++frame) {
      const int members = members_of(kind, params, frame);
      Frame sent = classic_frame(shared_id(kind, params, frame),
                                 static_cast<std::uint8_t>(members * kind.bytes_each()));
      for (int i = 0; i < members; ++i) {
        sent.data[i * kind.bytes_each()] = static_cast<std::uint8_t>(first_of(kind, frame) + i + 1);
      }
      for (int i = 0; i < members; ++i) {
        const int joint = first_of(kind, frame) + i;
        std::uint64_t heard = 0;
        int parts = 0;
        const PdoLength length = unpack_pdo(shared_mapping(kind, params, joint), sent,
                                            [&](Address at, unsigned bits, std::uint64_t value) {
                                              EXPECT_TRUE(at == kind.own.at);
                                              EXPECT_EQ(bits, kind.own.bits);
                                              heard = value;
                                              ++parts;
                                            });
        EXPECT_TRUE(length == PdoLength::kRight);
        EXPECT_EQ(parts, 1);
        EXPECT_EQ(heard, static_cast<std::uint64_t>(joint + 1));
        ++told;
      }
    }
    EXPECT_EQ(told, 21);
  }
}

TEST(RobotPlan, NoTwoSharedFramesHaveOneIdentifier) {
  const Params params = robot(kMaxJoints, true);
  std::uint16_t seen[64] = {};
  int count = 0;
  for (const Shared& kind : {kGoals, kWords, kStrengths}) {
    for (int frame = 0; frame < shared_frames(kind, params); ++frame) {
      const std::uint16_t id = shared_id(kind, params, frame);
      EXPECT_FALSE(is_restricted(id));
      for (int i = 0; i < count; ++i) EXPECT_NE(seen[i], id);
      seen[count++] = id;
    }
  }
  EXPECT_EQ(count, 16 + 8 + 8);
}

TEST(RobotPlan, TelemetryIsVoltageTemperatureAndErrorsFromTheLowEnd) {
  const Telemetry telemetry{0x0079, 41, 0x24};
  EXPECT_EQ(telemetry.value(), 0x24290079u);
  EXPECT_TRUE(Telemetry::from(0x24290079u) == telemetry);
}

}  // namespace
}  // namespace verp::canopen::plan
