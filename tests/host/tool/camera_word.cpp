#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/robot/camera_run.hpp"
#include "host/apps/tool/study/trace_pictures.hpp"
#include "host/os/link/link_error.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/support/video_device.hpp"

// The test plays the device: this PC's kernel has no camera.
namespace verp::tool {
namespace {

namespace fs = std::filesystem;

class CameraWord : public ::testing::Test {
 protected:
  CameraWord() {
    fs::create_directories(folder_);
    // Else a fast PC makes thousands of files.
    device_.on_wait = [this] {
      if (device_.made() < kPictures) device_.make_picture();
    };
    words_.device = device_.path;
    words_.json = true;
    words_.seconds = 0.3;
  }
  ~CameraWord() override { fs::remove_all(folder_); }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  static std::string bytes_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string run(int status = cli::kGood) {
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(run_camera(words_, device_), status);
    return ::testing::internal::GetCapturedStdout();
  }
  std::string refusal() {
    ::testing::internal::CaptureStdout();
    std::string line;
    try {
      run_camera(words_, device_);
      ADD_FAILURE() << "was not refused";
    } catch (const std::exception& error) {
      line = error.what();
    }
    ::testing::internal::GetCapturedStdout();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }

  static constexpr std::uint32_t kPictures = 40;
  // Tests run side by side; each removes its folder.
  fs::path folder_ = fs::path(::testing::TempDir()) /
                     fmt::format("verp-camera-word-{}",
                                 ::testing::UnitTest::GetInstance()->current_test_info()->name());
  test::VideoDevice device_;
  CameraWords words_;
};

TEST_F(CameraWord, TellsWhatThereIsAndCountsPictures) {
  const std::string answer = run();
  EXPECT_NE(answer.find("\"card\": \"Moving bar\""), std::string::npos) << answer;
  EXPECT_NE(answer.find("\"sizes\": \"16x8 32x24\""), std::string::npos) << answer;
  EXPECT_NE(answer.find("\"lost\": 0"), std::string::npos) << answer;
  EXPECT_EQ(answer.find("\"pictures\": 0,"), std::string::npos) << answer;
  EXPECT_EQ(device_.open_descriptors(), 0);
  words_.list = true;
  EXPECT_EQ(run().find("\"pictures\""), std::string::npos);
  words_.json = false;
  EXPECT_EQ(run(), "/dev/video7: Moving bar; YUYV 16x8 at 30 Hz\n  YUYV  a format: 16x8 32x24\n");
}

TEST_F(CameraWord, SaysThatItHasAnotherRateThanWasAsked) {
  words_.json = false;
  words_.list = true;
  words_.rate_hz = 60;
  device_.takes_any_rate = false;
  EXPECT_NE(run().find("at 30 Hz, not at the 60 of --rate\n"), std::string::npos);
  device_.takes_any_rate = true;
  EXPECT_NE(run().find("at 60 Hz\n"), std::string::npos);
  device_.refused[VIDIOC_G_PARM] = EINVAL;
  EXPECT_NE(run().find("16x8; it does not tell its rate\n"), std::string::npos);
}

TEST_F(CameraWord, WritesAPictureThatHasThePixels) {
  words_.picture = file("a.png");
  run();
  const std::string png = bytes_of(words_.picture);
  ASSERT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
  // Uncompressed rows, each after a filter byte 0.
  const std::uint32_t last = device_.made() - 1;
  std::string row(1, '\0');
  for (std::uint32_t x = 0; x < 16; ++x)
    row += std::string(3, x == device_.bar_of(last) ? '\xFF' : '\0');
  std::string rows;
  for (int y = 0; y < 8; ++y) rows += row;
  EXPECT_NE(png.find(rows), std::string::npos);
}

TEST_F(CameraWord, AJpegStaysAsTheCameraMadeIt) {
  device_.formats = {{V4L2_PIX_FMT_MJPEG, {{16, 8}}}};
  words_.picture = file("a.jpg");
  run();
  EXPECT_TRUE(bytes_of(words_.picture).starts_with("\xFF\xD8"));
  words_.picture = file("a.png");
  EXPECT_NE(refusal().find("name it .jpg"), std::string::npos);
  EXPECT_FALSE(fs::exists(words_.picture));
}

TEST_F(CameraWord, RecordsPicturesThatTracePicturesTakesOut) {
  words_.record = file("a.mcap");
  run();
  std::uint64_t last_ns = 0;
  const std::size_t count =
      record::for_each_picture(words_.record, [&](const record::RecordedPicture& each) {
        EXPECT_EQ(each.topic, "/camera/image");
        EXPECT_EQ(each.picture.encoding, "rgb8");
        EXPECT_EQ(each.picture.width, 16u);
        EXPECT_EQ(each.picture.data.size(), 16u * 8 * 3);
        if (last_ns > 0) {
          EXPECT_EQ(each.time_ns - last_ns, 33'000'000u);
        }
        last_ns = each.time_ns;
      });
  EXPECT_GT(count, 2u);
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(write_pictures(words_.record, file("pictures")), cli::kGood);
  ::testing::internal::GetCapturedStdout();
  std::size_t files = 0;
  for (const auto& each : fs::directory_iterator(file("pictures"))) {
    EXPECT_TRUE(bytes_of(each.path().string()).starts_with("\x89PNG"));
    ++files;
  }
  EXPECT_EQ(files, count);

  device_.formats = {{V4L2_PIX_FMT_MJPEG, {{16, 8}}}};
  words_.record = file("b.mcap");
  words_.compress = true;
  run();
  EXPECT_GT(record::for_each_picture(words_.record,
                                     [](const record::RecordedPicture& each) {
                                       EXPECT_EQ(each.topic, "/camera/image/compressed");
                                       EXPECT_EQ(each.picture.encoding, "jpeg");
                                       EXPECT_TRUE(each.picture.data.starts_with("\xFF\xD8"));
                                     }),
            2u);
}

TEST_F(CameraWord, OfOneThatIsPulledTellsWhatCameUntilThen) {
  int waits = 0;
  device_.on_wait = [&] {
    ++waits;
    if (waits == 5) device_.unplug();
    device_.make_picture();
  };
  words_.seconds = 1;
  words_.json = false;
  const std::string answer = run();
  EXPECT_NE(answer.find("no such device"), std::string::npos) << answer;
  EXPECT_EQ(device_.open_descriptors(), 0);
}

TEST_F(CameraWord, SaysWhatIsWrong) {
  device_.on_wait = {};
  EXPECT_NE(refusal().find("no picture in 0.3 s"), std::string::npos);
  words_.size = "640";
  EXPECT_NE(refusal().find("WIDTHxHEIGHT"), std::string::npos);
  words_.size = "640x480";
  EXPECT_NE(refusal().find("it has: YUYV 16x8 32x24"), std::string::npos);
  words_.size.clear();
  words_.device = "/dev/video9";
  EXPECT_NE(refusal().find("/dev/video9: no such device"), std::string::npos);
}

}  // namespace
}  // namespace verp::tool
