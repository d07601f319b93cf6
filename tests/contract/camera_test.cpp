#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "hal/contract/camera.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/camera.hpp.
namespace verp {
namespace {

template <class Backend>
class CameraContract : public ::testing::Test {
 protected:
  Backend camera;
  hal::CameraFrame frame;
};
TYPED_TEST_SUITE(CameraContract, test::Cameras);

TYPED_TEST(CameraContract, HasNothingBeforeTheFirstPicture) {
  this->frame.time_us = 7;
  EXPECT_EQ(this->camera.read(this->frame), hal::CameraStatus::kStale);
  EXPECT_EQ(this->frame.time_us, 7u) << "only kFresh changes the frame";
  EXPECT_EQ(this->frame.data, nullptr);
}

TYPED_TEST(CameraContract, GivesEachPictureOnceAndTheNewestOnlyAndCountsTheOthers) {
  this->camera.read(this->frame);
  std::uint64_t last_us = 0;
  for (std::uint32_t i = 1; i < 10; ++i) {
    this->camera.show();
    this->camera.show();
    ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
    EXPECT_EQ(this->frame.sequence, 2 * i - 1);
    EXPECT_EQ(this->frame.lost, 1u);
    EXPECT_TRUE(this->camera.is(this->frame, 2 * i - 1)) << i;
    EXPECT_GT(this->frame.time_us, last_us);
    last_us = this->frame.time_us;
    EXPECT_EQ(this->camera.read(this->frame), hal::CameraStatus::kStale);
    EXPECT_EQ(this->frame.sequence, 2 * i - 1);
  }
  this->camera.show();
  ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
  EXPECT_EQ(this->frame.lost, 0u);
  EXPECT_EQ(this->camera.faults(), 0u);
}

TYPED_TEST(CameraContract, SaysHowThePictureLies) {
  this->camera.read(this->frame);
  this->camera.show();
  ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
  const std::uint32_t row = hal::row_bytes(this->frame.format, this->frame.width_px);
  EXPECT_EQ(this->frame.width_px, TypeParam::kWidth);
  EXPECT_EQ(this->frame.height_px, TypeParam::kHeight);
  EXPECT_NE(this->frame.format, hal::PixelFormat::kNone);
  ASSERT_NE(this->frame.data, nullptr);
  if (row == 0) {
    EXPECT_EQ(this->frame.stride_bytes, 0u);
    EXPECT_GT(this->frame.size_bytes, 0u);
  } else {
    EXPECT_GE(this->frame.stride_bytes, row);
    EXPECT_GE(this->frame.size_bytes, this->frame.stride_bytes * (TypeParam::kHeight - 1) + row);
  }
}

TYPED_TEST(CameraContract, TheBytesStandStillUntilTheNextPictureIsFetched) {
  this->camera.read(this->frame);
  this->camera.show();
  ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
  EXPECT_EQ(this->camera.read(this->frame), hal::CameraStatus::kStale);
  for (int i = 0; i < 12; ++i) this->camera.show();
  EXPECT_TRUE(this->camera.is(this->frame, 0));
  ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
  // Backends keep different numbers of frames.
  EXPECT_EQ(this->frame.sequence, this->frame.lost + 1);
  EXPECT_TRUE(this->camera.is(this->frame, this->frame.sequence));
}

TYPED_TEST(CameraContract, CountsFaultsKeepsTheFrameAndComesBack) {
  if constexpr (TypeParam::kBreaks) {
    this->camera.read(this->frame);
    this->camera.show();
    ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
    const std::uint64_t before_us = this->frame.time_us;
    this->camera.break_it(true);
    for (std::uint32_t i = 1; i <= 3; ++i) {
      this->camera.wait();
      EXPECT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFault);
      EXPECT_EQ(this->camera.faults(), i);
    }
    EXPECT_EQ(this->frame.time_us, before_us);
    this->camera.break_it(false);
    this->camera.wait();
    this->camera.read(this->frame);  // reopens it
    const std::uint32_t faults = this->camera.faults();
    this->camera.show();
    ASSERT_EQ(this->camera.read(this->frame), hal::CameraStatus::kFresh);
    EXPECT_GT(this->frame.time_us, before_us);
    EXPECT_EQ(this->camera.faults(), faults);
  } else {
    EXPECT_EQ(this->camera.faults(), 0u);  // a twin's never fails
  }
}

}  // namespace
}  // namespace verp
