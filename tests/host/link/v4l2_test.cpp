#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "host/os/link/link_error.hpp"
#include "host/os/link/rgb.hpp"
#include "host/os/link/v4l2_camera.hpp"
#include "tests/support/video_device.hpp"

// tests/contract covers every camera.
namespace verp::link {
namespace {

using hal::CameraStatus;
using hal::PixelFormat;
using Kind = LinkError::Kind;
using test::VideoDevice;

struct Eye {
  static std::uint64_t now_ns() { return time_ns; }
  inline static std::uint64_t time_ns = 1;
};

/// Opening fails, and nothing stays open.
struct Refusal {
  Kind kind{};
  std::string line;
};
Refusal refusal(VideoDevice& device, const VideoWish& wish = {}, const std::string& path = {}) {
  try {
    const V4l2Camera camera(path.empty() ? device.path : path, wish, device);
  } catch (const LinkError& error) {
    EXPECT_EQ(device.open_descriptors(), 0) << error.what();
    EXPECT_EQ(device.mapped(), 0) << error.what();
    return {error.kind(), error.what()};
  }
  ADD_FAILURE() << "was not refused";
  return {};
}

void expect(const Refusal& refusal, Kind kind, const std::string& words) {
  EXPECT_EQ(refusal.kind, kind) << refusal.line;
  EXPECT_NE(refusal.line.find(words), std::string::npos) << refusal.line;
  EXPECT_EQ(refusal.line.find('\n'), std::string::npos);
  EXPECT_NE(refusal.line.find("; "), std::string::npos) << "and what to do: " << refusal.line;
}

TEST(V4l2, SaysWhyADeviceIsNoCamera) {
  VideoDevice device;
  expect(refusal(device, {}, "/dev/video9"), Kind::kNoDevice, "no such device");
  device.open_error = EACCES;
  expect(refusal(device), Kind::kPermission, "usermod -aG video");
  device.open_error = EBUSY;
  expect(refusal(device), Kind::kBusy, "fuser -v /dev/video7");
  device.open_error = 0;
  device.refused = {{VIDIOC_QUERYCAP, ENOTTY}};
  expect(refusal(device), Kind::kUnsuitable, "is no camera");
  device.refused = {{VIDIOC_S_FMT, EBUSY}};
  expect(refusal(device), Kind::kBusy, "another program");
  device.refused = {{VIDIOC_REQBUFS, EBUSY}};
  expect(refusal(device), Kind::kBusy, "another program");
  device.refused = {{VIDIOC_STREAMON, ENOSPC}};
  expect(refusal(device), Kind::kUnsuitable, "USB port has no room");
  device.refused = {{VIDIOC_STREAMON, ENODEV}};
  expect(refusal(device), Kind::kNoDevice, "unplugged");
  device.refused = {};
  device.capabilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  expect(refusal(device), Kind::kUnsuitable, "gives no pictures");
  device.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  expect(refusal(device), Kind::kUnsuitable, "several planes");
  device.capabilities = V4L2_CAP_VIDEO_CAPTURE;
  expect(refusal(device), Kind::kUnsuitable, "does not stream");
  device.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  device.buffers_at_most = 1;
  expect(refusal(device), Kind::kUnsuitable, "gives no buffers");
}

TEST(V4l2, OfTheRealKernelAFileAndAFolderAreNoCameras) {
  const auto why = [](const std::string& path) -> Refusal {
    try {
      const V4l2Camera camera(path, {});
    } catch (const LinkError& error) {
      return {error.kind(), error.what()};
    }
    return {};
  };
  expect(why("/dev/null"), Kind::kUnsuitable, "/dev/null: is no camera");
  expect(why("/dev"), Kind::kUnsuitable, "/dev: ");
  expect(why("/dev/video-that-is-none"), Kind::kNoDevice, "no such device");
}

TEST(V4l2, RefusesAPictureThatItDoesNotGiveAndListsThoseItDoes) {
  VideoDevice device;
  expect(refusal(device, {.width_px = 17, .height_px = 8}), Kind::kUnsuitable,
         "makes 16x8 of 17x8; it has: YUYV 16x8 32x24");
  expect(refusal(device, {.format = PixelFormat::kGrey}), Kind::kUnsuitable,
         "not give pictures in that format; it has: YUYV");
  device.formats = {{V4L2_PIX_FMT_NV12, {{16, 8}}}};
  expect(refusal(device), Kind::kUnsuitable, "none of YUYV, RGB3, GREY and MJPG");
}

TEST(V4l2, TakesSizeFormatAndRateThatWereAskedFor) {
  VideoDevice device;
  device.formats.push_back({V4L2_PIX_FMT_GREY, {{16, 8}, {20, 10}}});
  V4l2Camera camera(
      device.path, {.width_px = 20, .height_px = 10, .rate_hz = 12.5, .format = PixelFormat::kGrey},
      device);
  EXPECT_EQ(camera.width_px(), 20u);
  EXPECT_EQ(camera.height_px(), 10u);
  EXPECT_EQ(camera.format(), PixelFormat::kGrey);
  EXPECT_EQ(camera.rate_hz(), 12.5);
  EXPECT_EQ(device.rate_hz(), 12.5);
  EXPECT_EQ(camera.card(), "Moving bar");
  const auto formats = camera.formats();
  ASSERT_EQ(formats.size(), 2u);
  EXPECT_EQ(formats[1].code, "GREY");
  EXPECT_EQ(formats[1].sizes, "16x8 20x10");
}

TEST(V4l2, APictureInPartOrDamagedIsLost) {
  VideoDevice device;
  V4l2Camera camera(device.path, {}, device);
  hal::CameraFrame frame;
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  device.make_picture(0.5);
  EXPECT_EQ(camera.read(frame), CameraStatus::kStale);
  device.make_picture(0);
  device.make_picture(1, true);
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  EXPECT_EQ(frame.sequence, 4u);
  EXPECT_EQ(frame.lost, 3u);
  EXPECT_EQ(camera.damaged(), 3u);
  // A damaged picture follows.
  device.make_picture();
  device.make_picture(0.9);
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  EXPECT_EQ(frame.sequence, 5u);
}

TEST(V4l2, GivesAllBuffersBack) {
  VideoDevice device;
  V4l2Camera camera(device.path, {}, device);
  hal::CameraFrame frame;
  for (std::uint32_t i = 0; i < 100; ++i) {
    device.make_picture(i % 3 == 1 ? 0.5 : 1);
    device.make_picture();
    ASSERT_EQ(camera.read(frame), CameraStatus::kFresh) << i;
    ASSERT_EQ(frame.sequence, 2 * i + 1);
  }
}

TEST(V4l2, TheStampIsTheDriversOrTheReadsWhereItHasNone) {
  VideoDevice device;
  Eye::time_ns = 9'000'000'000;
  V4l2Camera camera(device.path, {}, device, Eye::now_ns);
  hal::CameraFrame frame;
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  EXPECT_EQ(frame.time_us, device.time_us());
  device.stamps = false;
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  EXPECT_EQ(frame.time_us, 9'000'000u);
}

TEST(V4l2, OfADriverThatNeverCountsNothingIsKnownToBeLost) {
  VideoDevice device;
  device.counts = false;
  V4l2Camera camera(device.path, {}, device);
  hal::CameraFrame frame;
  for (std::uint32_t i = 0; i < 5; ++i) {
    device.make_picture();
    ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(frame.lost, 0u);
  }
}

TEST(V4l2, UnpluggedItLetsGoOfTheDeviceSaysWhyAndStartsAnew) {
  VideoDevice device;
  Eye::time_ns = 1;
  V4l2Camera camera(device.path, {}, device, Eye::now_ns);
  hal::CameraFrame frame;
  device.make_picture();
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  device.unplug();
  EXPECT_EQ(camera.read(frame), CameraStatus::kFault);
  EXPECT_EQ(camera.trouble(), "/dev/video7: is unplugged");
  EXPECT_EQ(device.open_descriptors(), 0);
  EXPECT_EQ(device.mapped(), 0);
  Eye::time_ns += 1'000'000'000;
  EXPECT_EQ(camera.read(frame), CameraStatus::kFault);
  EXPECT_NE(camera.trouble().find("no such device"), std::string::npos);
  device.plug();
  EXPECT_EQ(camera.read(frame), CameraStatus::kFault) << "it is not asked for at every read";
  Eye::time_ns += 1'000'000'000;
  EXPECT_EQ(camera.read(frame), CameraStatus::kStale);
  EXPECT_EQ(camera.trouble(), "");
  const std::uint64_t before_us = frame.time_us;
  device.make_picture();
  ASSERT_EQ(camera.read(frame), CameraStatus::kFresh);
  EXPECT_EQ(frame.sequence, 0u);
  EXPECT_GT(frame.time_us, before_us);
  EXPECT_EQ(camera.faults(), 3u);
}

std::vector<std::uint8_t> rgb(PixelFormat format, std::uint32_t width_px,
                              const std::vector<std::uint8_t>& bytes) {
  const std::uint32_t row = hal::row_bytes(format, width_px);
  return rgb_of({.width_px = width_px,
                 .height_px = 1,
                 .format = format,
                 .stride_bytes = row,
                 .data = bytes.data(),
                 .size_bytes = bytes.size()});
}

TEST(Rgb, OfEachFormat) {
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(rgb(PixelFormat::kRgb, 2, {1, 2, 3, 4, 5, 6}), (Bytes{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(rgb(PixelFormat::kGrey, 2, {7, 9}), (Bytes{7, 7, 7, 9, 9, 9}));
  EXPECT_EQ(rgb(PixelFormat::kYuyv, 2, {16, 128, 235, 128}), (Bytes{0, 0, 0, 255, 255, 255}));
  // BT.601's colour bars of 100 %: red 81, 90, 240; green 145, 54, 34; blue 41, 240, 110, rounded
  // by the standard.
  const auto near = [](const Bytes& seen, const Bytes& meant) {
    ASSERT_EQ(seen.size(), meant.size());
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_NEAR(seen[i], meant[i], 2) << i;
  };
  near(rgb(PixelFormat::kYuyv, 2, {81, 90, 81, 240}), {255, 0, 0, 255, 0, 0});
  near(rgb(PixelFormat::kYuyv, 2, {145, 54, 145, 34}), {0, 255, 0, 0, 255, 0});
  near(rgb(PixelFormat::kYuyv, 2, {41, 240, 41, 110}), {0, 0, 255, 0, 0, 255});
  EXPECT_EQ(rgb(PixelFormat::kYuyv, 2, {16, 128, 235}), Bytes{}) << "a byte is missing";
  EXPECT_EQ(rgb(PixelFormat::kJpeg, 2, {0xFF, 0xD8, 1, 2}), Bytes{});
}

}  // namespace
}  // namespace verp::link
