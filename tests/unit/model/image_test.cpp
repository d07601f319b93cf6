#include "common/model/image.hpp"

#include <gtest/gtest.h>

#include "common/control/golden.hpp"

namespace verp {
namespace {

ParamsImage image;  // 4 KB: too much for a microcontroller's stack

/// Three joints in a row.
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
  }
  for (std::uint32_t k = 0; k < kGoldenVectors; ++k) {
    image.golden[k] = control::golden_vector(image.params, k + 1);
  }
  seal_image(image);
}

ImageFault check() {
  return check_image(&image, sizeof image);
}

// The catalogue's check value: the same CRC as zip's, on every core.
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
  EXPECT_TRUE(check() == ImageFault::kNone);  // sealing writes this core's version
  image.header.core_version = kCoreVersion + 1;
  EXPECT_TRUE(check() == ImageFault::kOtherCore);
  image.header.image_version = kImageVersion + 1;
  EXPECT_TRUE(check() == ImageFault::kOtherLayout);
  image.header.magic[7] = '2';
  EXPECT_TRUE(check() == ImageFault::kNotAnImage);
}

// A sound CRC does not make an index sound: the image may come from another program.
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
  image.params.leg[1].solver = LegSolver::kNewton;
  image.params.leg[1].joint[5] = 3;
  EXPECT_FALSE(is_well_formed(image.params));
  seal_image(image);
  EXPECT_TRUE(check() == ImageFault::kOutOfBounds);
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
  image.params.bus_protocol = static_cast<BusProtocol>(2);
  EXPECT_FALSE(is_well_formed(image.params));
}

// A difference of a micrometre changes what kinematics gives.
TEST(Image, GoldenVectorsNoticeAnotherRobot) {
  make_image();
  image.params.joint[0].origin_parent_m.z = 0.100001F;
  EXPECT_LT(control::count_golden_matches(image), kGoldenVectors);
}

}  // namespace
}  // namespace verp
