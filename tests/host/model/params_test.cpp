#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "common/control/golden.hpp"
#include "common/control/self_test.hpp"
#include "common/kinematics/forward.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/check.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/servo_types.hpp"
#include "tests/host/model/test_files.hpp"

namespace verp::model {
namespace {

const Entity& generic21() {
  static const Entity kEntity = load_robot(robot_file("generic21"));
  return kEntity;
}

TEST(Params, ForwardKinematicsAgreesWithTheEntity) {
  const Entity& e = generic21();
  const Params params = make_params(e);
  std::mt19937 random(1);
  for (int round = 0; round < 100; ++round) {
    float angle_rad[kMaxJoints] = {};
    std::vector<Transform> pose = {Transform::Identity()};
    for (std::size_t j = 0; j < e.joints.size(); ++j) {
      const Joint& joint = e.joints[j];
      angle_rad[j] = std::uniform_real_distribution<float>(
          static_cast<float>(joint.lower_rad), static_cast<float>(joint.upper_rad))(random);
      pose.push_back(pose[static_cast<std::size_t>(joint.parent)] *
                     Eigen::Translation3d(joint.origin_m) *
                     Eigen::AngleAxisd(angle_rad[j], joint.axis));
    }
    for (int node = 0; node <= params.joint_count; ++node) {
      const verp::Pose found = kinematics::node_pose(params, verp::Pose{}, angle_rad, node);
      const Transform& wanted = pose[static_cast<std::size_t>(node)];
      EXPECT_LT((found.position_m.cast<double>() - wanted.translation()).norm(), 1e-6);
      EXPECT_LT((found.rotation.cast<double>() - wanted.linear()).norm(), 1e-5);
    }
  }
}

TEST(Params, LegSolverReachesWhatTheLegReached) {
  const Params params = make_params(generic21());
  std::mt19937 random(2);
  for (int round = 0; round < 1000; ++round) {
    const LegParams& leg = params.leg[round % 2];
    float angle_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) {
      const JointParams& joint = params.joint[leg.joint[k]];
      angle_rad[k] =
          std::uniform_real_distribution<float>(joint.lower_rad, joint.upper_rad)(random);
    }
    angle_rad[3] = std::max(angle_rad[3], 0.1F);
    const verp::Pose sole =
        kinematics::sole_pose(leg, kinematics::leg_chain(params, leg, verp::Pose{}, angle_rad));
    const kinematics::LegAngles solved = kinematics::solve_leg(params, leg, sole, angle_rad);
    if (solved.flags != 0) continue;  // another posture, beyond a limit
    const verp::Pose again = kinematics::sole_pose(
        leg, kinematics::leg_chain(params, leg, verp::Pose{}, solved.angle_rad));
    EXPECT_LT((again.position_m - sole.position_m).norm(), 1e-5F);
    EXPECT_LT((again.rotation - sole.rotation).norm(), 1e-4F);
  }
}

TEST(Params, ServoScalesFollowDirectionAndOffset) {
  const Params params = make_params(generic21());
  for (int j = 0; j < params.joint_count; ++j) {
    EXPECT_NEAR(std::abs(params.joint[j].counts_per_rad), 651.8986F, 1e-3F);
    EXPECT_EQ(params.joint[j].counts_per_rad < 0,
              generic21().joints[static_cast<std::size_t>(j)].servo.direction < 0);
    EXPECT_EQ(params.joint[j].zero_count, 2048.0F);
    EXPECT_NEAR(params.joint[j].compliance_rad_nm, 1 / 53.7F, 1e-4F);
  }
  EXPECT_EQ(params.servo[0].model_number, 1030);
  EXPECT_EQ(params.servo[1].model_number, 0);
}

TEST(Params, DefaultsOfTheTuningAreWithinTheirRanges) {
  const Params params = make_params(generic21());
  ASSERT_EQ(tuning_names().size(), static_cast<std::size_t>(kTuningCount));
  for (int id = 0; id < kTuningCount; ++id) {
    EXPECT_TRUE(in_range(id, tuning_value(params.tuning, id)))
        << tuning_names()[static_cast<std::size_t>(id)];
  }
  EXPECT_EQ(tuning_id("gait.cycle_s"), 0);
  EXPECT_FALSE(tuning_id("gait.cycles").has_value());
}

TEST(Params, TooManyKindsOfServoSettingsAreRefused) {
  Entity entity = generic21();
  for (std::size_t j = 0; j < 5; ++j)
    entity.joints[j].servo.p_gain = static_cast<std::uint16_t>(1000 + j);
  EXPECT_THROW(make_params(entity), LoadError);
}

TEST(Image, IsReadBackAsWritten) {
  const ParamsImage image = make_image(generic21());
  const TemporaryFile file("params.bin",
                           std::string(reinterpret_cast<const char*>(&image), sizeof image));
  const ParamsImage again = read_image(file.path());
  EXPECT_EQ(std::memcmp(&image, &again, sizeof image), 0);
  EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kNone);
}

// As in `verp flash --params FILE`.
TEST(Image, NumberThatIsNoneIsToldByItsName) {
  ParamsImage image = make_image(generic21());
  image.params.joint[3].upper_rad = std::numeric_limits<float>::quiet_NaN();
  seal_image(image);
  const TemporaryFile file("params.bin",
                           std::string(reinterpret_cast<const char*>(&image), sizeof image));
  try {
    read_image(file.path());
    FAIL() << "taken";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("joint[3].upper_rad"), std::string::npos)
        << error.what();
  }
}

TEST(Image, CrcIsTheOneOfZip) {
  EXPECT_EQ(crc32("123456789", 9), 0xCBF43926u);
}

TEST(Image, EverySingleFlippedBitIsFound) {
  ParamsImage image = make_image(generic21());
  auto* bytes = reinterpret_cast<unsigned char*>(&image);
  for (std::size_t at = 0; at < sizeof image; at += 7) {
    bytes[at] ^= 1u << (at % 8);
    EXPECT_NE(check_image(bytes, sizeof image), ImageFault::kNone) << at;
    bytes[at] ^= 1u << (at % 8);
  }
}

TEST(Image, TruncatedForeignAndInconsistentAreTold) {
  ParamsImage image = make_image(generic21());
  EXPECT_EQ(check_image(&image, sizeof image - 1), ImageFault::kTruncated);
  EXPECT_EQ(check_image(&image, 3), ImageFault::kTruncated);
  image.params.joint[3].parent = 9;
  seal_image(image);
  EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kOutOfBounds);
  image.header.image_version += 1;
  EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kOtherLayout);
  image.header.magic[0] = 'X';
  EXPECT_EQ(check_image(&image, sizeof image), ImageFault::kNotAnImage);
  const TemporaryFile file("params.bin", "short");
  EXPECT_THROW(read_image(file.path()), LoadError);
}

TEST(Image, GoldenVectorsAndSelfTestAreReproduced) {
  const ParamsImage image = make_image(generic21());
  EXPECT_EQ(control::count_golden_matches(image), kGoldenVectors);
  const auto scratch = std::make_unique<State>();
  const std::uint64_t digest = control::self_test_digest(image.params, *scratch);
  EXPECT_EQ(static_cast<std::uint32_t>(digest), image.self_test_digest[0]);
  EXPECT_EQ(static_cast<std::uint32_t>(digest >> 32), image.self_test_digest[1]);
  EXPECT_EQ(image.self_test_ticks, 256u);
}

TEST(Image, GoldenVectorsNoticeOneUlpOfLength) {
  ParamsImage image = make_image(generic21());
  image.params.leg[0].thigh_m = std::nextafter(image.params.leg[0].thigh_m, 1.0F);
  EXPECT_LT(control::count_golden_matches(image), kGoldenVectors);
}

TEST(Image, HeaderHoldsTheSameBytes) {
  const ParamsImage image = make_image(generic21());
  const std::string header = image_header(image);
  EXPECT_NE(header.find("verp_params_image[" + std::to_string(sizeof image) + "]"),
            std::string::npos);
  EXPECT_NE(header.find("0x56, 0x45, 0x52, 0x50,"), std::string::npos);  // "VERP"
}

TEST(Image, OverfullBusIsRefused) {
  Entity entity = generic21();
  entity.baud = 115200;
  EXPECT_THROW(make_image(entity), LoadError);
}

TEST(Check, SaysWhatABuilderAsksFirst) {
  const std::string text = describe(generic21());
  for (const char* const part :
       {"21 joints, 3.262 kg", "left_leg 6 DOF", "head 3 DOF", "closed form", "thigh 93.0 mm",
        "xm430_w210", "l_ankle_roll", "camera on skull", "lidar on trunk", "CRC-32"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  const std::string json = describe_json(generic21());
  EXPECT_NE(json.find("\"solver\": \"closed_form\""), std::string::npos);
  EXPECT_NE(json.find("\"dof\": 21"), std::string::npos);
}

std::string servo_line(const std::string& text, const std::string& type) {
  const std::size_t at = text.find("servo " + type + ":");
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST(Check, SaysWhichServosAreIdentifiedAndWhichAreScaledWithinABand) {
  std::string text = read_text(robot_file("generic21"));
  const std::string was = "type=\"xm430_w210\"";
  text.replace(text.find(was), was.size(), "type=\"mx64\"");
  const TemporaryFile file("robot.sdf", text);
  const std::string said = describe(load_robot(file.path()));
  const std::string measured = servo_line(said, "mx64"), scaled = servo_line(said, "xm430_w210");
  EXPECT_NE(measured.find("identified: "), std::string::npos) << said;
  EXPECT_EQ(measured.find("+-"), std::string::npos) << measured;
  EXPECT_NE(scaled.find("scaled by "), std::string::npos) << said;
  EXPECT_NE(scaled.find("at the joint +-50 %"), std::string::npos) << scaled;
}

TEST(ServoTypes, EachFamilyHasARowThatSaysWhereItsNumbersAreFrom) {
  for (const char* family : {"mx28", "mx64", "mx106", "xl330", "xl430", "xc330", "xc430", "xm430",
                             "xh430", "xm540", "xh540"}) {
    int rows = 0;
    for (const ServoType& type : servo_types()) {
      if (!type.name.starts_with(family)) continue;
      ++rows;
      const bool identified = type.source.starts_with("identified: ");
      EXPECT_NE(identified, type.source.starts_with("scaled by ")) << type.name << type.source;
      EXPECT_EQ(identified, type.armature_band == 0) << type.name;
      EXPECT_EQ(identified, type.friction_band == 0) << type.name;
      EXPECT_GT(type.gearbox.armature_kg_m2, 0) << type.name;
      EXPECT_GT(type.gearbox.l_base + type.gearbox.l_strib, 0) << type.name;
    }
    EXPECT_GT(rows, 0) << family;
  }
}

}  // namespace
}  // namespace verp::model
