#include "common/model/image.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "common/control/golden.hpp"

namespace verp {
namespace {

ParamsImage image;  // too large for a microcontroller's stack

void make_image() {
  image = ParamsImage{};
  image.params.joint_count = 3;
  for (int j = 0; j < 3; ++j) {
    JointParams& joint = image.params.joint[j];
    joint.parent = static_cast<std::uint8_t>(j);
    joint.axis_kind = j == 1 ? AxisKind::kY : AxisKind::kZ;
    joint.axis = j == 1 ? Xyz{0, 1, 0} : Xyz{0, 0, 1};
    joint.origin_parent_m = {0.01F, 0.02F, 0.1F};
    joint.mass_kg = 0.1F;
    joint.lower_rad = -1;
    joint.upper_rad = 1;
    joint.velocity_limit_rad_s = 6;
    joint.counts_per_rad = 652;
  }
  image.params.imu.gyro_rad_s_per_count = 1e-3F;
  image.params.imu.accel_m_s2_per_count = 1e-3F;
  for (std::uint32_t k = 0; k < kGoldenVectors; ++k) {
    image.golden[k] = control::golden_vector(image.params, k + 1);
  }
  seal_image(image);
}

ImageFault check() {
  return check_image(&image, sizeof image);
}

TEST(Image, CrcIsTheOneOfZip) {
  EXPECT_EQ(crc32("123456789", 9), 0xCBF43926u);
  EXPECT_EQ(crc32("6789", 4, crc32("12345", 5)), 0xCBF43926u);
}

TEST(Image, SealedImageIsSound) {
  make_image();
  EXPECT_TRUE(check() == ImageFault::kNone);
  EXPECT_EQ(control::count_golden_matches(image), kGoldenVectors);
}

TEST(Image, DamageIsFound) {
  make_image();
  image.params.joint[1].mass_kg = 0.2F;
  EXPECT_TRUE(check() == ImageFault::kDamaged);
  EXPECT_TRUE(check_image(&image, sizeof image - 1) == ImageFault::kTruncated);
  EXPECT_TRUE(check_image(&image, 4) == ImageFault::kTruncated);
  image.header.core_version = kCoreVersion + 1;
  seal_image(image);
  EXPECT_TRUE(check() == ImageFault::kNone);
  image.header.core_version = kCoreVersion + 1;
  EXPECT_TRUE(check() == ImageFault::kOtherCore);
  image.header.image_version = kImageVersion + 1;
  EXPECT_TRUE(check() == ImageFault::kOtherLayout);
  image.header.magic[7] = '2';
  EXPECT_TRUE(check() == ImageFault::kNotAnImage);
}

// A sound CRC does not make an index valid.
TEST(Image, IndicesOutsideTheirTablesAreFound) {
  make_image();
  image.params.joint[1].parent = 2;
  EXPECT_FALSE(is_well_formed(image.params));
  make_image();
  image.params.joint_count = kMaxJoints + 1;
  EXPECT_FALSE(is_well_formed(image.params));
  make_image();
  image.params.joint[2].servo_profile = kServoProfiles;
  EXPECT_FALSE(is_well_formed(image.params));
  make_image();
  image.params.head_pan = 3;
  EXPECT_FALSE(is_well_formed(image.params));
  make_image();
  image.params.arm[1] = 3;
  EXPECT_FALSE(is_well_formed(image.params));
  make_image();
  image.params.leg[1].solver = LegSolver::kNewton;
  image.params.leg[1].joint[5] = 3;
  EXPECT_FALSE(is_well_formed(image.params));
  seal_image(image);
  EXPECT_TRUE(check() == ImageFault::kOutOfBounds);
  make_image();
  image.params.leg[0].joint[2] = 112;
  EXPECT_FALSE(is_well_formed(image.params)) << "the gait reads it, although no solver does";
}

TEST(Image, ABusThatCannotBeIsFound) {
  make_image();
  for (int j = 0; j < 3; ++j) image.params.joint[j].servo_id = static_cast<std::uint8_t>(j + 125);
  image.params.imu.device_id = 200;
  EXPECT_TRUE(is_well_formed(image.params)) << "on the serial bus";
  image.params.bus_protocol = BusProtocol::kCia402;
  EXPECT_FALSE(is_well_formed(image.params)) << "node 200";
  image.params.imu.device_id = 0;
  EXPECT_TRUE(is_well_formed(image.params));
  image.params.feet.device_id[1] = 128;
  EXPECT_FALSE(is_well_formed(image.params));
  image.params.feet.device_id[1] = 0;
  image.params.joint[1].servo_id = 0;
  EXPECT_FALSE(is_well_formed(image.params));
  image.params.joint[1].servo_id = 1;
  image.params.bus_protocol = static_cast<BusProtocol>(3);
  EXPECT_FALSE(is_well_formed(image.params));
}

constexpr float kNan = __builtin_nanf("");

/// Empty if all fit.
template <class Change>
std::string bad_with(Change change) {
  make_image();
  change(image.params);
  seal_image(image);
  FieldName bad;
  const bool fits = numbers_fit(image.params, bad);
  EXPECT_EQ(check() == ImageFault::kNone, fits);
  EXPECT_EQ(check() == ImageFault::kOutOfRange, !fits);
  return bad.text;
}

TEST(Image, NumbersThatAreNoneOrNoRobotsAreNamed) {
  EXPECT_EQ(bad_with([](Params&) {}), "");
  EXPECT_EQ(bad_with([](Params& p) { p.joint[2].lower_rad = kNan; }), "joint[2].lower_rad");
  EXPECT_EQ(bad_with([](Params& p) { p.joint[1].upper_rad = -2; }), "joint[1].upper_rad")
      << "below lower_rad";
  EXPECT_EQ(bad_with([](Params& p) { p.joint[0].counts_per_rad = 0; }), "joint[0].counts_per_rad");
  EXPECT_EQ(bad_with([](Params& p) { p.joint[0].velocity_limit_rad_s = -1; }),
            "joint[0].velocity_limit_rad_s");
  EXPECT_EQ(bad_with([](Params& p) { p.joint[1].origin_parent_m.z = 1e9F; }),
            "joint[1].origin_parent_m");
  EXPECT_EQ(bad_with([](Params& p) { p.body_mass_kg = -0.1F; }), "body_mass_kg");
  EXPECT_EQ(bad_with([](Params& p) { p.period_us = 0; }), "period_us");
  EXPECT_EQ(bad_with([](Params& p) { p.arm_rad_per_m[1] = kNan; }), "arm_rad_per_m");
  EXPECT_EQ(bad_with([](Params& p) { p.imu.accel_m_s2_per_count = 0; }),
            "imu.accel_m_s2_per_count");
  EXPECT_EQ(bad_with([](Params& p) { p.tuning.gait.cycle_s = 0.1F; }), "tuning.gait.cycle_s");
  EXPECT_EQ(bad_with([](Params& p) { p.tuning.safety.temperature_high_c = kNan; }),
            "tuning.safety.temperature_high_c");
  EXPECT_EQ(bad_with([](Params& p) { p.joint[5].lower_rad = kNan; }), "")
      << "no joint of this robot";
  EXPECT_EQ(bad_with([](Params& p) { p.leg[1].thigh_m = kNan; }), "") << "it has no legs";
  EXPECT_EQ(bad_with([](Params& p) {
              p.leg[1].solver = LegSolver::kNewton;
              p.leg[1].thigh_m = kNan;
            }),
            "leg[1].thigh_m");
}

TEST(Image, ARobotWithoutJointsHasFiniteNumbersToo) {
  const auto without_joints = [](float stand_rad) {
    return bad_with([=](Params& params) {
      params.joint_count = 0;
      params.joint[0].stand_rad = stand_rad;
    });
  };
  EXPECT_EQ(without_joints(0), "");
  EXPECT_EQ(without_joints(kNan), "joint[0].stand_rad");
}

TEST(Image, EveryNumberOfAJointIsLookedAt) {
  make_image();
  constexpr std::size_t kFloats = 22;
  static float* number[kFloats];
  std::size_t count = 0;
  for_each_leaf(image.params.joint[1], [&](auto& value) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(value)>, float>) {
      number[count++ % kFloats] = &value;
    }
  });
  ASSERT_EQ(count, kFloats);
  for (float* each : number) {
    const float before = *each;
    *each = kNan;
    FieldName bad;
    EXPECT_FALSE(numbers_fit(image.params, bad)) << each - number[0];
    *each = before;
  }
}

TEST(Image, GoldenVectorsNoticeAnotherRobot) {
  make_image();
  image.params.joint[0].origin_parent_m.z = 0.100001F;
  EXPECT_LT(control::count_golden_matches(image), kGoldenVectors);
}

}  // namespace
}  // namespace verp
