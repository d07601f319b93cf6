#include "host/os/link/v4l2_camera.hpp"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

#include "host/os/link/link_error.hpp"
#include "host/os/link/v4l2_formats.hpp"

namespace verp::link {
namespace {

using hal::PixelFormat;
using Kind = LinkError::Kind;

constexpr std::uint32_t kBuffers = 4;  ///< one held, one filling, two spare
constexpr std::uint64_t kReopen_ns = 200'000'000;
constexpr std::uint32_t kMostPixels = 16384;  ///< each way; more is a driver's error

std::string cameras_here() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", error)) {
    if (entry.path().filename().string().starts_with("video")) names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());
  return names.empty() ? "no camera is plugged in"
                       : fmt::format("there are: {}", fmt::join(names, " "));
}

}  // namespace

V4l2Camera::V4l2Camera(std::string device, const VideoWish& wish, VideoCalls& calls, Now now)
    : device_(std::move(device)), wish_(wish), calls_(calls), now_(now) {
  open();
}

V4l2Camera::~V4l2Camera() {
  close();
}

void V4l2Camera::refuse(int error, const std::string& what) const {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      throw LinkError(Kind::kNoDevice, device_ + ": no such device; " + cameras_here());
    case EACCES:
    case EPERM:
      throw LinkError(Kind::kPermission, device_ +
                                             ": no permission; join the group that may: sudo "
                                             "usermod -aG video $USER, then log in again");
    case EBUSY:
      throw LinkError(Kind::kBusy, device_ + ": another program has it open; end that, fuser -v " +
                                       device_ + " names it");
    case ENODEV:
    case ENXIO:
      throw LinkError(Kind::kNoDevice, device_ + ": is unplugged; plug it in again");
    case ENOSPC:
      throw LinkError(Kind::kUnsuitable,
                      device_ +
                          ": its USB port has no room for that stream; ask for a smaller picture "
                          "(--size), a lower --rate or --format MJPG, or plug it in elsewhere");
    default:
      throw LinkError(Kind::kUnsuitable, fmt::format("{}: {} ({}); unplug it and plug it in again",
                                                     device_, what, std::strerror(error)));
  }
}

void V4l2Camera::open() {
  descriptor_ = calls_.open(device_.c_str());
  if (descriptor_ < 0) refuse(errno, "cannot be opened");
  try {
    require_camera();
    choose_format();
    choose_rate();
    map_buffers();
    start();
  } catch (const LinkError&) {
    close();
    throw;
  }
}

void V4l2Camera::close() {
  if (descriptor_ < 0) return;
  int type = v4l2::kCapture;
  ask(VIDIOC_STREAMOFF, &type);
  for (const Buffer& buffer : buffers_) calls_.unmap(buffer.bytes, buffer.size);
  buffers_.clear();
  held_ = -1;
  calls_.close(std::exchange(descriptor_, -1));
}

void V4l2Camera::require_camera() {
  v4l2_capability able{};
  if (ask(VIDIOC_QUERYCAP, &able) < 0) {
    if (errno == ENODEV) refuse(errno, "");
    throw LinkError(Kind::kUnsuitable, device_ + ": is no camera; " + cameras_here());
  }
  card_ = v4l2::text_of(able.card);
  const std::uint32_t has =
      (able.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? able.device_caps : able.capabilities;
  const auto lacks = [&](const std::string& what) {
    throw LinkError(Kind::kUnsuitable,
                    fmt::format("{}: {} {}; {}", device_, card_, what, cameras_here()));
  };
  if ((has & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    lacks((has & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0
              ? "gives pictures in several planes, which is not read here"
              : "gives no pictures there: choose its other device");
  }
  if ((has & V4L2_CAP_STREAMING) == 0) lacks("does not stream");
}

void V4l2Camera::choose_format() {
  const std::vector<v4l2::Listed> formats = v4l2::listed_formats(calls_, descriptor_);
  const auto refuse_wish = [&](const std::string& what) {
    throw LinkError(Kind::kUnsuitable, fmt::format("{}: {} {}; it has: {}", device_, card_, what,
                                                   v4l2::in_one_line(formats)));
  };
  const auto code =
      std::find_if(v4l2::kCodes.begin(), v4l2::kCodes.end(), [&](const v4l2::Code& each) {
        if (wish_.format != PixelFormat::kNone && each.format != wish_.format) return false;
        return std::any_of(formats.begin(), formats.end(),
                           [&](const v4l2::Listed& one) { return one.code == each.code; });
      });
  if (code == v4l2::kCodes.end()) {
    refuse_wish(wish_.format == PixelFormat::kNone
                    ? "gives none of YUYV, RGB3, GREY and MJPG, which are read here"
                    : "does not give pictures in that format");
  }
  v4l2_format format{};
  format.type = v4l2::kCapture;
  if (ask(VIDIOC_G_FMT, &format) < 0) refuse(errno, "does not tell its format");
  v4l2_pix_format& pixels = format.fmt.pix;
  if (wish_.width_px > 0) pixels.width = wish_.width_px;
  if (wish_.height_px > 0) pixels.height = wish_.height_px;
  pixels.pixelformat = code->code;
  pixels.field = V4L2_FIELD_NONE;
  pixels.bytesperline = 0;
  pixels.sizeimage = 0;
  if (ask(VIDIOC_S_FMT, &format) < 0) refuse(errno, "does not take that format");
  if (pixels.pixelformat != code->code) refuse_wish("does not give pictures in that format");
  if (pixels.field == V4L2_FIELD_ALTERNATE)
    refuse_wish("gives every other row at a time, which is not read here");
  if ((wish_.width_px > 0 && pixels.width != wish_.width_px) ||
      (wish_.height_px > 0 && pixels.height != wish_.height_px)) {
    refuse_wish(fmt::format("makes {}x{} of {}x{}", pixels.width, pixels.height, wish_.width_px,
                            wish_.height_px));
  }
  const std::uint32_t row = hal::row_bytes(code->format, pixels.width);
  if (pixels.width == 0 || pixels.height == 0 || pixels.width > kMostPixels ||
      pixels.height > kMostPixels || (pixels.bytesperline != 0 && pixels.bytesperline < row)) {
    refuse_wish(fmt::format("says {}x{} in rows of {} bytes, which is no picture", pixels.width,
                            pixels.height, pixels.bytesperline));
  }
  width_px_ = pixels.width;
  height_px_ = pixels.height;
  format_ = code->format;
  stride_bytes_ = row == 0 ? 0 : std::max(row, pixels.bytesperline);
}

/// The driver takes the nearest rate that it supports.
void V4l2Camera::choose_rate() {
  v4l2_streamparm parameters{};
  parameters.type = v4l2::kCapture;
  v4l2_captureparm& capture = parameters.parm.capture;
  if (ask(VIDIOC_G_PARM, &parameters) < 0) return;
  if (wish_.rate_hz > 0 && (capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
    capture.timeperframe = {1000, static_cast<__u32>(std::lround(1000 * wish_.rate_hz))};
    if (ask(VIDIOC_S_PARM, &parameters) < 0) refuse(errno, "does not take a rate");
  }
  const v4l2_fract& period = capture.timeperframe;
  rate_hz_ = period.numerator == 0 ? 0 : 1.0 * period.denominator / period.numerator;
}

void V4l2Camera::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = v4l2::kCapture;
  request.memory = V4L2_MEMORY_MMAP;
  if (ask(VIDIOC_REQBUFS, &request) < 0) refuse(errno, "gives no buffers");
  if (request.count < 2) refuse(ENOMEM, "gives no buffers");
  const std::size_t least = stride_bytes_ == 0 ? 1
                                               : std::size_t{stride_bytes_} * (height_px_ - 1) +
                                                     hal::row_bytes(format_, width_px_);
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer{};
    buffer.index = i;
    buffer.type = v4l2::kCapture;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (ask(VIDIOC_QUERYBUF, &buffer) < 0) refuse(errno, "does not tell of its buffers");
    if (buffer.length < least) refuse(ENOBUFS, "has buffers too small for its pictures");
    std::uint8_t* bytes = calls_.map(descriptor_, buffer.length, buffer.m.offset);
    if (bytes == nullptr) refuse(errno, "its buffers cannot be mapped");
    buffers_.push_back({bytes, buffer.length});
  }
}

void V4l2Camera::start() {
  for (std::uint32_t i = 0; i < buffers_.size(); ++i) {
    if (!give_back(i)) refuse(errno, "does not take its buffers");
  }
  int type = v4l2::kCapture;
  if (ask(VIDIOC_STREAMON, &type) < 0) refuse(errno, "does not start");
  next_sequence_ = 0;
  trouble_.clear();
}

bool V4l2Camera::give_back(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = v4l2::kCapture;
  buffer.memory = V4L2_MEMORY_MMAP;
  return ask(VIDIOC_QBUF, &buffer) == 0;
}

bool V4l2Camera::try_again() {
  if (now_() < retry_ns_) return false;
  retry_ns_ = now_() + kReopen_ns;
  try {
    open();
    return true;
  } catch (const LinkError& error) {
    trouble_ = error.what();
    return false;
  }
}

hal::CameraStatus V4l2Camera::read(hal::CameraFrame& frame) {
  if (descriptor_ < 0 && !try_again()) {
    ++faults_;
    return hal::CameraStatus::kFault;
  }
  const int error = take_newest(frame);
  if (error == 0) return hal::CameraStatus::kFresh;
  if (error == EAGAIN) return hal::CameraStatus::kStale;
  trouble_ = device_ + ": " + (error == ENODEV ? "is unplugged" : std::strerror(error));
  close();
  retry_ns_ = now_() + kReopen_ns;
  ++faults_;
  return hal::CameraStatus::kFault;
}

/// 0; EAGAIN: no picture; else an errno.
int V4l2Camera::take_newest(hal::CameraFrame& frame) {
  const std::size_t row = hal::row_bytes(format_, width_px_);
  const std::size_t least = row == 0 ? 4 : std::size_t{stride_bytes_} * (height_px_ - 1) + row;
  std::optional<v4l2_buffer> newest;
  int error = EAGAIN;
  // Limits the loop: a device may fill buffers as fast as they return.
  for (std::size_t taken = 0; taken < 2 * buffers_.size(); ++taken) {
    v4l2_buffer buffer{};
    buffer.type = v4l2::kCapture;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (ask(VIDIOC_DQBUF, &buffer) < 0) {
      error = errno;
      break;
    }
    if (buffer.index >= buffers_.size()) continue;
    const bool whole = (buffer.flags & V4L2_BUF_FLAG_ERROR) == 0 && buffer.bytesused >= least &&
                       buffer.bytesused <= buffers_[buffer.index].size;
    if (!whole) ++damaged_;
    const std::optional<v4l2_buffer> older = whole ? std::exchange(newest, buffer) : buffer;
    if (older) give_back(older->index);
  }
  if (error != EAGAIN || !newest) return error;
  if (held_ >= 0) give_back(static_cast<std::uint32_t>(held_));
  held_ = static_cast<int>(newest->index);
  // Some drivers never count; then losses are unknown.
  const std::uint32_t gap = newest->sequence - next_sequence_;
  frame.lost = gap < 0x8000'0000U ? gap : 0;
  frame.sequence = gap < 0x8000'0000U ? newest->sequence : next_sequence_;
  next_sequence_ = frame.sequence + 1;
  const bool stamped =
      (newest->flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  const std::uint64_t time_us =
      stamped ? 1'000'000 * static_cast<std::uint64_t>(newest->timestamp.tv_sec) +
                    static_cast<std::uint64_t>(newest->timestamp.tv_usec)
              : now_() / 1000;
  frame.time_us = last_us_ = std::max(time_us, last_us_ + 1);
  frame.width_px = width_px_;
  frame.height_px = height_px_;
  frame.format = format_;
  frame.stride_bytes = stride_bytes_;
  frame.data = buffers_[newest->index].bytes;
  frame.size_bytes = newest->bytesused;
  return 0;
}

void V4l2Camera::wait(int time_ms) {
  if (descriptor_ >= 0 && calls_.wait(descriptor_, time_ms) >= 0) return;
  sleep_until_ns(monotonic_ns() + 1'000'000 * static_cast<std::uint64_t>(std::min(time_ms, 20)));
}

std::vector<VideoFormat> V4l2Camera::formats() const {
  std::vector<VideoFormat> formats;
  for (const v4l2::Listed& each : v4l2::listed_formats(calls_, descriptor_))
    formats.push_back(each.shown);
  return formats;
}

}  // namespace verp::link
