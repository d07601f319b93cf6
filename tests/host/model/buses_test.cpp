#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

std::string refusal(const std::string& old_part, const std::string& new_part,
                    const std::string& bus = "") {
  std::string text = read_text(robot_file("generic21"));
  const auto at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  text.replace(at, old_part.size(), new_part);
  const TemporaryFile file("robot.sdf", text);
  try {
    load_robot(file.path(), bus);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "";
}

const std::string kCan = "<verp:bus name=\"can\" protocol=\"cia402\" baud=\"1000000\"";
const std::string kDrive = "<verp:servo joint=\"head_yaw\" id=\"19\" direction=\"1\" type=\"cia402";

TEST(Buses, TheFirstIsUsedUnlessAnotherIsNamed) {
  const Entity serial = load_robot(robot_file("generic21"));
  const Entity can = load_robot(robot_file("generic21"), "can");
  EXPECT_EQ(serial.bus, "dxl");
  EXPECT_EQ(can.bus, "can");
  EXPECT_EQ(serial.buses, (std::vector<std::string>{"dxl", "can", "feetech"}));
  EXPECT_EQ(make_params(serial).bus_protocol, BusProtocol::kDynamixel2);
  const Params params = make_params(can);
  EXPECT_EQ(params.bus_protocol, BusProtocol::kCia402);
  EXPECT_EQ(params.baud, 1'000'000u);
  EXPECT_EQ(params.servo[0].profile_ms, 0) << "60C2h follows the control period";
}

TEST(Buses, DrivesOfTheSameJointsAreAsStiffAsTheServos) {
  const Params serial = make_params(load_robot(robot_file("generic21")));
  const Params can = make_params(load_robot(robot_file("generic21"), "can"));
  ASSERT_EQ(serial.joint_count, can.joint_count);
  for (int j = 0; j < serial.joint_count; ++j) {
    const JointParams& a = serial.joint[j];
    const JointParams& b = can.joint[j];
    EXPECT_STREQ(a.name, b.name);
    EXPECT_EQ(a.servo_id, b.servo_id);
    EXPECT_FLOAT_EQ(4 * a.counts_per_rad, b.counts_per_rad);
    EXPECT_FLOAT_EQ(4 * a.zero_count, b.zero_count);
    EXPECT_FLOAT_EQ(a.compliance_rad_nm, b.compliance_rad_nm);
    EXPECT_NEAR(a.lower_rad, b.lower_rad, 2e-3);
    EXPECT_NEAR(a.upper_rad, b.upper_rad, 2e-3);
  }
}

TEST(Buses, OneThatDoesNotExistIsRefusedWithThoseThatDo) {
  const std::string line = refusal("<mass>1.1</mass>", "<mass>1.1</mass>", "usb");
  EXPECT_NE(line.find("no bus 'usb'; choose one of: dxl, can"), std::string::npos) << line;
}

TEST(Buses, AllAreCheckedWhicheverIsUsed) {
  struct Case {
    std::string from, to, said;
  };
  const std::string baud = "baud=\"1000000\"";
  const Case cases[] = {
      {kCan, "<verp:bus name=\"dxl\" protocol=\"cia402\" " + baud, "bus 'dxl' is given twice"},
      {kCan, "<verp:bus name=\"can\" protocol=\"ethercat\" " + baud, "no bus protocol 'ethercat'"},
      {kCan, "<verp:bus name=\"can\" protocol=\"cia402\" baud=\"600000\"", "no bit rate"},
      {kCan, "<verp:bus name=\"can\" protocol=\"cia402\" baud=\"800000\"", "no bit rate"},
      {kCan, "<verp:bus name=\"can\" protocol=\"dynamixel2\" " + baud, "does not speak dynamixel2"},
      {kDrive + "_w210\"", "<verp:servo joint=\"head_yaw\" id=\"19\" type=\"mx28\"",
       "servo type 'mx28' does not speak cia402; choose one of: cia402_w210"},
      {kDrive, "<verp:servo profile_ms=\"10\" joint=\"head_yaw\" id=\"19\" type=\"cia402",
       "profile_ms"},
      {kDrive, "<verp:servo joint=\"head_yaw\" id=\"126\" direction=\"1\" type=\"cia402", "126"},
      {"<verp:imu sensor=\"imu\" id=\"120\"", "<verp:imu sensor=\"imu\" id=\"150\"",
       "id 150 is no node id of bus 'can'"},
  };
  for (const Case& each : cases) {
    const std::string line = refusal(each.from, each.to);
    EXPECT_NE(line.find(each.said), std::string::npos) << each.to << '\n' << line;
  }
}

TEST(Buses, OneThatCannotCarryATickIsRefused) {
  const std::string line =
      refusal(kCan, "<verp:bus name=\"can\" protocol=\"cia402\" baud=\"125000\"", "can");
  EXPECT_NE(line.find("a tick's packets take"), std::string::npos) << line;
}

// 87 % of the period, and over 100 % when every drive changes its state.
TEST(Buses, OneWithoutRoomNamesTheFirstDriveThatDoesNotFit) {
  const std::string slow = kCan + " period_us=\"10000\"";
  const std::string fast = kCan + " period_us=\"6000\"";
  const std::string line = refusal(slow, fast, "can");
  const std::string text = read_text(robot_file("generic21"));
  const auto bus = text.begin() + static_cast<std::ptrdiff_t>(text.find(kCan));
  const std::string place = ":" + std::to_string(1 + std::count(text.begin(), bus, '\n')) + ": ";
  for (const std::string& part :
       {place + "r_knee (node 13) and those after it do not fit", std::string("87.0 % of 6000 us"),
        std::string("109.8 %"), std::string("a period of 7 ms has room")}) {
    EXPECT_NE(line.find(part), std::string::npos) << line;
  }
}

TEST(Buses, TheDriveThatIsNamedIsTheFirstThatDoesNotFit) {
  const Entity entity = load_robot(robot_file("generic21"), "can");
  Params params = make_params(entity);
  params.period_us = 6000;
  EXPECT_THROW(require_bus(entity, params), LoadError);
  int knee = 0;
  while (params.joint[knee].servo_id != 13) ++knee;
  params.joint_count = static_cast<std::uint8_t>(knee);
  EXPECT_NO_THROW(require_bus(entity, params));
  params.joint_count = static_cast<std::uint8_t>(knee + 1);
  EXPECT_THROW(require_bus(entity, params), LoadError);
}

// Under 80 %, but such a tick would run into the next.
TEST(Buses, AChangeOfAllStatesHasToFitThePeriod) {
  const Entity entity = load_robot(robot_file("generic21"), "can");
  Params params = make_params(entity);
  params.period_us = 6550;
  EXPECT_LT(bus_time(params).share, 0.8);
  EXPECT_GT(bus_time(params).change_us, 6550);
  EXPECT_THROW(require_bus(entity, params), LoadError);
  params.period_us = 7000;
  EXPECT_NO_THROW(require_bus(entity, params));
}

TEST(Buses, TheShareOfATickFollowsFromTheRate) {
  Params params = make_params(load_robot(robot_file("generic21"), "can"));
  const BusTime fast = bus_time(params);
  EXPECT_LT(fast.share, 0.7);
  params.baud = 500'000;
  EXPECT_NEAR(bus_time(params).us, 2 * fast.us, 2);
  params.period_us *= 2;
  EXPECT_NEAR(bus_time(params).share, fast.share, 1e-3);
}

const std::string kFeetech = "<verp:bus name=\"feetech\" protocol=\"feetech\" baud=\"1000000\"";
const std::string kSts = "type=\"sts3215\" backlash_rad=\"0.0087\" p_gain=\"97\"/>";

TEST(Buses, FeetechServosOfTheSameJointsAreAboutAsStiff) {
  const Params dynamixel = make_params(load_robot(robot_file("generic21")));
  const Params feetech = make_params(load_robot(robot_file("generic21"), "feetech"));
  EXPECT_EQ(feetech.bus_protocol, BusProtocol::kFeetech);
  EXPECT_EQ(feetech.baud, 1'000'000u);
  EXPECT_EQ(feetech.servo[0].model_number, 777);
  EXPECT_EQ(feetech.servo[0].position_p_gain, 97);
  EXPECT_EQ(feetech.servo[0].position_d_gain, 32) << "the factory's";
  EXPECT_EQ(feetech.servo[0].profile_ms, 0);
  for (int j = 0; j < dynamixel.joint_count; ++j) {
    EXPECT_NEAR(dynamixel.joint[j].compliance_rad_nm, feetech.joint[j].compliance_rad_nm, 2e-4);
  }
}

TEST(Buses, TwoSerialProtocolsOnOneBusAreRefused) {
  const std::string mixed = refusal(kSts, "type=\"xm430_w210\"/>", "feetech");
  EXPECT_NE(mixed.find("servo type 'xm430_w210' does not speak feetech"), std::string::npos)
      << mixed;
  EXPECT_NE(mixed.find("robot.sdf:617:"), std::string::npos) << mixed;
  EXPECT_NE(mixed.find("choose one of: sts3215"), std::string::npos) << mixed;
}

TEST(Buses, WhatFeetechServosLackIsRefused) {
  const auto named = [](const std::string& old_part, const std::string& new_part) {
    return refusal(old_part, new_part, "feetech");
  };
  EXPECT_NE(named(kFeetech, "<verp:bus name=\"feetech\" protocol=\"feetech\" baud=\"2000000\"")
                .find("baud"),
            std::string::npos);
  EXPECT_NE(named(kFeetech, "<verp:bus name=\"feetech\" protocol=\"feetech\" baud=\"57600\"")
                .find("choose one of: 1000000, 500000, 250000, 128000, 115200"),
            std::string::npos);
  EXPECT_NE(named(kSts, "type=\"sts3215\" profile_ms=\"10\"/>").find("profile"), std::string::npos);
  EXPECT_NE(named(kSts, "type=\"sts3215\" p_gain=\"255\"/>").find("254"), std::string::npos);
  EXPECT_NE(named("protocol=\"feetech\"", "protocol=\"feetch\"").find("\"feetech\""),
            std::string::npos);
}

}  // namespace
}  // namespace verp::model
