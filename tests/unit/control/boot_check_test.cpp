#include "common/control/boot_check.hpp"

#include <gtest/gtest.h>

#include "common/control/golden.hpp"
#include "common/control/self_test.hpp"
#include "common/safety/machine.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::control {
namespace {

Params robot;
State state;

// Too large for a microcontroller's stack.
ParamsImage& sealed_image() {
  static ParamsImage image;
  image = ParamsImage{};
  image.params = test::kRobot;
  for (std::uint32_t k = 0; k < kGoldenVectors; ++k) {
    image.golden[k] = golden_vector(image.params, k + 1);
  }
  const std::uint64_t digest = self_test_digest(image.params, state);
  image.self_test_ticks = kSelfTestTicks;
  image.self_test_digest[0] = static_cast<std::uint32_t>(digest);
  image.self_test_digest[1] = static_cast<std::uint32_t>(digest >> 32);
  seal_image(image);
  return image;
}

BootVerdict verdict_on(const ParamsImage& image, std::size_t size = sizeof(ParamsImage)) {
  return check_boot(&image, size, robot, state).verdict;
}

// Changes with kCoreVersion.
TEST(BootCheck, BuiltInRobotWalksTheSameBitsInEveryBuild) {
  const std::uint64_t digest = built_in_digest(robot, state);
  EXPECT_EQ(static_cast<std::uint32_t>(digest >> 32),
            static_cast<std::uint32_t>(kBuiltInDigest >> 32));
  EXPECT_EQ(static_cast<std::uint32_t>(digest), static_cast<std::uint32_t>(kBuiltInDigest));
}

TEST(BootCheck, BuiltInRobotWalksForReal) {
  built_in_digest(robot, state);
  EXPECT_TRUE(is_well_formed(robot));
  EXPECT_TRUE(state.machine.mode == safety::Mode::kWalking);
  EXPECT_TRUE(state.gait.queue[0].phase == gait::Phase::kFinal) << "stopping, after";
  EXPECT_NE(int{state.gait.previous.swing}, int{gait::kBoth}) << "steps";
  EXPECT_NE(int{state.gait.queue[0].swing}, int{gait::kBoth}) << "of both feet";
  EXPECT_TRUE(test::struct_is_finite(state));
}

TEST(BootCheck, SoundImageIsSound) {
  const ParamsImage& image = sealed_image();
  const BootReport report = check_boot(&image, sizeof image, robot, state);
  EXPECT_TRUE(report.verdict == BootVerdict::kSound);
  EXPECT_EQ(int{report.golden_matches}, kGoldenVectors);
}

TEST(BootCheck, DamagedTruncatedOrMissingImageIsRefused) {
  ParamsImage& image = sealed_image();
  EXPECT_TRUE(verdict_on(image, sizeof image - 1) == BootVerdict::kImage);
  EXPECT_TRUE(verdict_on(image, 0) == BootVerdict::kImage);
  test::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const auto at = static_cast<std::size_t>(random.below(sizeof image));
    auto* bytes = reinterpret_cast<unsigned char*>(&image);
    const auto before = bytes[at];
    bytes[at] = static_cast<unsigned char>(before ^ 1U << random.below(8));
    EXPECT_TRUE(verdict_on(image) == BootVerdict::kImage) << "byte " << at;
    bytes[at] = before;
  }
  EXPECT_TRUE(verdict_on(image) == BootVerdict::kSound);
}

TEST(BootCheck, AnswersOfAnotherCoreAreRefused) {
  ParamsImage& image = sealed_image();
  image.golden[3].legs_digest ^= 1;
  seal_image(image);
  EXPECT_TRUE(verdict_on(image) == BootVerdict::kKinematics);
  sealed_image().self_test_digest[0] ^= 1;
  seal_image(image);
  EXPECT_TRUE(verdict_on(image) == BootVerdict::kControl);
  sealed_image().self_test_ticks = 0;
  seal_image(image);
  EXPECT_TRUE(verdict_on(image) == BootVerdict::kControl) << "an image without a self-test";
  sealed_image().params.tuning.gait.lift_m *= 1.001F;
  seal_image(image);
  EXPECT_TRUE(verdict_on(image) == BootVerdict::kControl);
}

// NaN answers the same everywhere.
TEST(BootCheck, ImageWithANumberThatIsNoneIsRefusedByName) {
  ParamsImage& image = sealed_image();
  image.params.joint[14].velocity_limit_rad_s = test::quiet_nan();
  for (std::uint32_t k = 0; k < kGoldenVectors; ++k) {
    image.golden[k] = golden_vector(image.params, k + 1);
  }
  const std::uint64_t digest = self_test_digest(image.params, state);
  image.self_test_digest[0] = static_cast<std::uint32_t>(digest);
  image.self_test_digest[1] = static_cast<std::uint32_t>(digest >> 32);
  seal_image(image);
  const BootReport report = check_boot(&image, sizeof image, robot, state);
  EXPECT_TRUE(report.verdict == BootVerdict::kImage);
  EXPECT_TRUE(report.image == ImageFault::kOutOfRange);
  EXPECT_STREQ(report.bad_field.text, "joint[14].velocity_limit_rad_s");
}

TEST(BootCheck, EveryVerdictHasWords) {
  for (const char* words : kBootWords) EXPECT_TRUE(words != nullptr && words[0] != '\0');
}

}  // namespace
}  // namespace verp::control
