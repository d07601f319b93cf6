#include "host/apps/tool/robot/camera_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/png.hpp"
#include "host/os/link/rgb.hpp"
#include "host/os/link/v4l2_camera.hpp"
#include "host/study/report/files.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/ros_camera.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

using hal::CameraFrame;
using hal::PixelFormat;

constexpr std::array kFormatCodes = {
    std::pair{"YUYV", PixelFormat::kYuyv}, std::pair{"RGB3", PixelFormat::kRgb},
    std::pair{"GREY", PixelFormat::kGrey}, std::pair{"MJPG", PixelFormat::kJpeg}};

link::VideoWish wish_of(const CameraWords& words) {
  link::VideoWish wish{.width_px = 0, .height_px = 0, .rate_hz = words.rate_hz};
  for (const auto& [code, format] : kFormatCodes) {
    if (words.format == code) wish.format = format;
  }
  if (words.size.empty()) return wish;
  constexpr unsigned kMost = 8192;
  unsigned width = 0, height = 0;
  int end = 0;
  const int read = std::sscanf(words.size.c_str(), "%5ux%5u%n", &width, &height, &end);
  if (read != 2 || end != static_cast<int>(words.size.size()) || width == 0 || height == 0 ||
      width > kMost || height > kMost) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp bus camera: --size {}: give WIDTHxHEIGHT, each 1 to {}, such "
                    "as 640x480",
                    words.size, kMost));
  }
  wish.width_px = width;
  wish.height_px = height;
  return wish;
}

/// Checks before any recording that the file's name fits the format. A camera that encodes JPEG
/// offers nothing else.
void require_picture_name(const std::string& file, PixelFormat format) {
  const std::string kind = std::filesystem::path(file).extension().string();
  const bool jpeg = format == PixelFormat::kJpeg;
  if (jpeg ? kind == ".jpg" || kind == ".jpeg" : kind == ".png") return;
  throw cli::ToolError(
      cli::kBadInput,
      jpeg ? fmt::format("verp bus camera: -o {}: the camera gives JPEG files, and they "
                         "stay as they are; name it .jpg, or ask for --format YUYV",
                         file)
           : fmt::format("verp bus camera: -o {}: the camera gives pixels; name it "
                         ".png, or ask for --format MJPG",
                         file));
}

void write_camera_picture(const CameraFrame& frame, const std::string& file) {
  const std::string_view bytes(reinterpret_cast<const char*>(frame.data), frame.size_bytes);
  report::write_file(file, frame.format == PixelFormat::kJpeg
                               ? bytes
                               : png_of_rgb(frame.width_px, frame.height_px, link::rgb_of(frame)));
}

/// A trace with one camera, timed from the start.
class CameraRecording {
 public:
  CameraRecording(const CameraWords& words, const link::V4l2Camera& camera)
      : writer_(
            words.record, "ros2", "verp",
            words.compress ? record::mcap::Compression::kZstd : record::mcap::Compression::kNone) {
    record::mcap::StringMap metadata = record::build_info();
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    metadata.insert_or_assign("device", words.device);
    metadata.insert_or_assign("camera", camera.card());
    metadata.insert_or_assign(
        "begun_unix_s",
        fmt::format("{}", std::chrono::duration_cast<std::chrono::seconds>(now).count()));
    writer_.add_metadata("verp", metadata);
    const bool jpeg = camera.format() == PixelFormat::kJpeg;
    const record::ros::MessageType& type =
        jpeg ? record::ros::kCompressedImage : record::ros::kImage;
    channel_ = writer_.add_channel(writer_.add_schema(type.name, "ros2msg", type.schema),
                                   jpeg ? "/camera/image/compressed" : "/camera/image", "cdr");
  }
  void keep(const CameraFrame& frame) {
    if (!begun_us_) begun_us_ = frame.time_us;
    const std::uint64_t time_ns = 1000 * (frame.time_us - *begun_us_);
    record::ros::Picture picture{
        .encoding = {}, .width = frame.width_px, .height = frame.height_px, .data = {}};
    if (frame.format == PixelFormat::kJpeg) {
      picture.encoding = "jpeg";
      picture.data.assign(reinterpret_cast<const char*>(frame.data), frame.size_bytes);
    } else {
      const std::vector<std::uint8_t> rgb = link::rgb_of(frame);
      picture.encoding = "rgb8";
      picture.data.assign(rgb.begin(), rgb.end());
    }
    writer_.add_message(channel_, time_ns,
                        record::ros::picture(picture, "camera_optical", time_ns));
    constexpr std::uint64_t kPicturesOfChunk = 8;
    if (++pictures_ % kPicturesOfChunk == 0) writer_.flush();
  }
  void close() { pictures_ == 0 ? writer_.discard() : writer_.close(); }

 private:
  record::mcap::Writer writer_;
  std::uint16_t channel_ = 0;
  std::optional<std::uint64_t> begun_us_;
  std::uint64_t pictures_ = 0;
};

struct Watched {
  std::uint64_t pictures = 0, lost = 0, first_us = 0, last_us = 0;

  double rate_hz() const {
    return pictures < 2
               ? 0
               : 1e6 * static_cast<double>(pictures - 1) / static_cast<double>(last_us - first_us);
  }
};

Watched watch_camera(link::V4l2Camera& camera, const CameraWords& words,
                     CameraRecording* recording) {
  Watched seen;
  CameraFrame frame;
  constexpr int kWait_ms = 50;
  // Many cameras expose their first pictures wrongly.
  constexpr std::uint64_t kSettled = 10;
  const std::uint64_t end_ns =
      link::monotonic_ns() + static_cast<std::uint64_t>(1e9 * words.seconds);
  while (link::monotonic_ns() < end_ns && !cli::interrupted()) {
    if (camera.read(frame) != hal::CameraStatus::kFresh) {
      camera.wait(kWait_ms);
      continue;
    }
    if (seen.pictures++ == 0) seen.first_us = frame.time_us;
    if (seen.pictures > 1) seen.lost += frame.lost;
    seen.last_us = frame.time_us;
    if (recording != nullptr) recording->keep(frame);
    if (words.picture.empty()) continue;
    const bool settled = seen.pictures == kSettled;
    if (seen.pictures == 1 || settled) write_camera_picture(frame, words.picture);
    if (settled && recording == nullptr) break;
  }
  return seen;
}

const char* code_of(PixelFormat format) {
  const auto found = std::find_if(kFormatCodes.begin(), kFormatCodes.end(),
                                  [&](const auto& each) { return each.second == format; });
  return found == kFormatCodes.end() ? "?" : found->first;
}

/// Many drivers silently use the nearest of a few rates.
std::string rate_in_words(const link::V4l2Camera& camera, const CameraWords& words) {
  if (camera.rate_hz() <= 0) return words.rate_hz > 0 ? "; it does not tell its rate" : "";
  const bool another = words.rate_hz > 0 && std::abs(camera.rate_hz() / words.rate_hz - 1) > 0.01;
  return fmt::format(" at {:g} Hz", camera.rate_hz()) +
         (another ? fmt::format(", not at the {:g} of --rate", words.rate_hz) : "");
}

std::string camera_in_words(const link::V4l2Camera& camera, const CameraWords& words) {
  std::string text =
      fmt::format("{}: {}; {} {}x{}{}\n", words.device, camera.card(), code_of(camera.format()),
                  camera.width_px(), camera.height_px(), rate_in_words(camera, words));
  for (const link::VideoFormat& each : camera.formats()) {
    text += fmt::format("  {}  {}{}{}\n", each.code, each.name,
                        each.sizes.empty() ? "" : ": " + each.sizes,
                        each.format == PixelFormat::kNone ? " (not read here)" : "");
  }
  return text;
}

cli::Json camera_in_json(const link::V4l2Camera& camera, const CameraWords& words) {
  cli::Json formats = cli::Json::array();
  for (const link::VideoFormat& each : camera.formats()) {
    formats.push_back({{"code", each.code},
                       {"name", each.name},
                       {"sizes", each.sizes},
                       {"is_read", each.format != PixelFormat::kNone}});
  }
  return {{"device", words.device},
          {"card", camera.card()},
          {"format", code_of(camera.format())},
          {"width", camera.width_px()},
          {"height", camera.height_px()},
          {"rate_hz", camera.rate_hz()},
          {"formats", formats}};
}

}  // namespace

int run_camera(const CameraWords& words, link::VideoCalls& calls) {
  link::V4l2Camera camera(words.device, wish_of(words), calls);
  if (!words.picture.empty()) require_picture_name(words.picture, camera.format());
  cli::Json answered = camera_in_json(camera, words);
  if (!words.json) cli::answer(camera_in_words(camera, words));
  if (words.list) {
    if (words.json) cli::print_json(answered);
    return cli::kGood;
  }
  std::optional<CameraRecording> recording;
  if (!words.record.empty()) recording.emplace(words, camera);
  const Watched seen = watch_camera(camera, words, recording ? &*recording : nullptr);
  if (recording) recording->close();
  if (seen.pictures == 0) {
    throw cli::ToolError(
        cli::kNoDevice,
        fmt::format("verp bus camera: {}: no picture in {:g} s{}; look at its cable and its "
                    "shutter, or ask for another --format",
                    words.device, words.seconds,
                    camera.trouble().empty() ? "" : " (" + camera.trouble() + ")"));
  }
  if (words.json) {
    answered["pictures"] = seen.pictures;
    answered["measured_hz"] = seen.rate_hz();
    answered["lost"] = seen.lost;
    answered["damaged"] = camera.damaged();
    answered["faults"] = camera.faults();
    cli::print_json(answered);
    return cli::kGood;
  }
  cli::answer(fmt::format("{} pictures, {:.1f} a second, {} lost, {} damaged{}\n", seen.pictures,
                          seen.rate_hz(), seen.lost, camera.damaged(),
                          camera.trouble().empty() ? "" : "; " + camera.trouble()));
  return cli::kGood;
}

}  // namespace verp::tool
