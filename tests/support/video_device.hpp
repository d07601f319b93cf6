#pragma once
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host/os/link/video_calls.hpp"

/// A V4L2 capture device behind the kernel's calls, written from the kernel's documentation. Its
/// bar moves right by one column per picture.
namespace verp::test {

class VideoDevice final : public link::VideoCalls {
 public:
  struct Format {
    std::uint32_t code;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
  };
  static constexpr std::uint8_t kDark = 16, kBright = 235, kNoColour = 128;

  // Script.
  std::string path = "/dev/video7";
  std::vector<Format> formats = {{V4L2_PIX_FMT_YUYV, {{16, 8}, {32, 24}}}};
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::uint32_t padding = 0;  ///< bytes after each row
  std::uint32_t buffers_at_most = 8;
  bool stamps = true;  ///< pictures carry the monotonic clock
  bool counts = true;  ///< pictures are numbered
  bool takes_any_rate = true;
  int open_error = 0;
  std::map<unsigned long, int> refused;  ///< request -> errno
  std::function<void()> on_wait;         ///< while a caller waits

  void unplug() {
    plugged_ = false;
    streaming_ = false;
    queued_.clear();
    done_.clear();
  }
  void plug() { plugged_ = true; }
  /// Fills a queued buffer; without one the picture is lost. `part` of its bytes arrive.
  void make_picture(double part = 1, bool damaged = false) {
    time_us_ += 33'000;
    const std::uint32_t number = sequence_++;
    if (!streaming_ || queued_.empty()) return;
    v4l2_buffer buffer{};
    buffer.index = queued_.front();
    queued_.pop_front();
    std::vector<std::uint8_t>& bytes = memory_[buffer.index];
    buffer.bytesused = static_cast<std::uint32_t>(part * draw(number, bytes));
    buffer.sequence = counts ? number : 0;
    buffer.flags =
        (stamps ? V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC : 0U) | (damaged ? V4L2_BUF_FLAG_ERROR : 0U);
    if (stamps)
      buffer.timestamp = {static_cast<long>(time_us_ / 1'000'000),
                          static_cast<long>(time_us_ % 1'000'000)};
    done_.push_back(buffer);
  }
  std::uint32_t bar_of(std::uint32_t number) const { return number % width_; }
  std::uint32_t made() const { return sequence_; }
  std::uint64_t time_us() const { return time_us_; }
  /// 0 once the camera is gone.
  int open_descriptors() const { return descriptors_; }
  int mapped() const { return mapped_; }
  double rate_hz() const { return 1.0 * period_.denominator / period_.numerator; }

  int open(const char* name) override {
    if (!plugged_ || name != path) return fail(ENOENT);
    if (open_error != 0) return fail(open_error);
    ++descriptors_;
    alive_ = ++last_;
    return alive_;
  }
  void close(int descriptor) override {
    --descriptors_;
    if (descriptor != alive_) return;
    streaming_ = false;
    queued_.clear();
    done_.clear();
  }
  int ioctl(int descriptor, unsigned long request, void* argument) override {
    if (!plugged_ || descriptor != alive_) return fail(ENODEV);
    if (const auto error = refused.find(request); error != refused.end())
      return fail(error->second);
    switch (request) {
      case VIDIOC_QUERYCAP:
        return tell_capabilities(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return tell_format(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_ENUM_FRAMESIZES:
        return tell_size(*static_cast<v4l2_frmsizeenum*>(argument));
      case VIDIOC_G_FMT:
        return tell_current(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_FMT:
        return set_format(*static_cast<v4l2_format*>(argument));
      case VIDIOC_G_PARM:
      case VIDIOC_S_PARM:
        return rate(*static_cast<v4l2_streamparm*>(argument), request == VIDIOC_S_PARM);
      case VIDIOC_REQBUFS:
        return make_buffers(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return tell_buffer(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        return queue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        streaming_ = true;
        sequence_ = 0;
        return 0;
      case VIDIOC_STREAMOFF:
        streaming_ = false;
        queued_.clear();
        done_.clear();
        return 0;
      default:
        return fail(ENOTTY);
    }
  }
  std::uint8_t* map(int, std::size_t size, std::int64_t offset) override {
    const auto index = static_cast<std::size_t>(offset / kOffset);
    if (index >= memory_.size() || size > memory_[index].size()) {
      errno = EINVAL;
      return nullptr;
    }
    ++mapped_;
    return memory_[index].data();
  }
  void unmap(std::uint8_t*, std::size_t) override { --mapped_; }
  int wait(int, int) override {
    if (on_wait) on_wait();
    if (!plugged_) return fail(ENODEV);
    return done_.empty() ? 0 : 1;
  }

 private:
  static constexpr std::int64_t kOffset = 1 << 20;

  static int fail(int error) {
    errno = error;
    return -1;
  }
  template <std::size_t kSize>
  static void put(__u8 (&to)[kSize], const char* text) {
    std::strncpy(reinterpret_cast<char*>(to), text, kSize - 1);
  }
  int tell_capabilities(v4l2_capability& able) const {
    put(able.card, "Moving bar");
    put(able.driver, "test");
    able.capabilities = capabilities | V4L2_CAP_DEVICE_CAPS;
    able.device_caps = capabilities;
    return 0;
  }
  int tell_format(v4l2_fmtdesc& format) const {
    if (format.index >= formats.size()) return fail(EINVAL);
    format.pixelformat = formats[format.index].code;
    put(format.description, "a format");
    return 0;
  }
  int tell_size(v4l2_frmsizeenum& size) const {
    for (const Format& each : formats) {
      if (each.code != size.pixel_format || size.index >= each.sizes.size()) continue;
      size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
      size.discrete = {each.sizes[size.index].first, each.sizes[size.index].second};
      return 0;
    }
    return fail(EINVAL);
  }
  std::uint32_t row() const {
    switch (code_) {
      case V4L2_PIX_FMT_YUYV:
        return 2 * width_;
      case V4L2_PIX_FMT_RGB24:
        return 3 * width_;
      case V4L2_PIX_FMT_GREY:
        return width_;
      default:
        return 0;
    }
  }
  int tell_current(v4l2_format& format) const {
    v4l2_pix_format& pixels = format.fmt.pix;
    pixels = {};
    pixels.width = width_;
    pixels.height = height_;
    pixels.pixelformat = code_;
    pixels.field = V4L2_FIELD_NONE;
    pixels.bytesperline = row() == 0 ? 0 : row() + padding;
    pixels.sizeimage = row() == 0 ? 4096 : pixels.bytesperline * height_;
    return 0;
  }
  /// An impossible format becomes a possible one.
  int set_format(v4l2_format& format) {
    const v4l2_pix_format wanted = format.fmt.pix;
    const Format* chosen = &formats.at(0);
    for (const Format& each : formats) {
      if (each.code == wanted.pixelformat) chosen = &each;
    }
    code_ = chosen->code;
    std::tie(width_, height_) = chosen->sizes.at(0);
    for (const auto& [width, height] : chosen->sizes) {
      if (width != wanted.width || height != wanted.height) continue;
      width_ = width;
      height_ = height;
    }
    return tell_current(format);
  }
  int rate(v4l2_streamparm& parameters, bool set) {
    if (set && takes_any_rate) period_ = parameters.parm.capture.timeperframe;
    parameters.parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    parameters.parm.capture.timeperframe = period_;
    return 0;
  }
  int make_buffers(v4l2_requestbuffers& request) {
    request.count = std::min(request.count, buffers_at_most);
    v4l2_format format{};
    tell_current(format);
    memory_.assign(request.count, std::vector<std::uint8_t>(format.fmt.pix.sizeimage));
    return 0;
  }
  int tell_buffer(v4l2_buffer& buffer) const {
    if (buffer.index >= memory_.size()) return fail(EINVAL);
    buffer.length = static_cast<std::uint32_t>(memory_[buffer.index].size());
    buffer.m.offset = static_cast<std::uint32_t>(kOffset * buffer.index);
    return 0;
  }
  int queue(const v4l2_buffer& buffer) {
    if (buffer.index >= memory_.size()) return fail(EINVAL);
    for (const std::uint32_t each : queued_) {
      if (each == buffer.index) return fail(EINVAL);
    }
    queued_.push_back(buffer.index);
    return 0;
  }
  int dequeue(v4l2_buffer& buffer) {
    if (!streaming_) return fail(EINVAL);
    if (done_.empty()) return fail(EAGAIN);
    buffer = done_.front();
    done_.pop_front();
    return 0;
  }
  std::uint32_t draw(std::uint32_t number, std::vector<std::uint8_t>& bytes) const {
    if (row() == 0) {
      const std::uint8_t file[] = {0xFF, 0xD8, static_cast<std::uint8_t>(number), 0xFF, 0xD9};
      std::memcpy(bytes.data(), file, sizeof file);
      return sizeof file;
    }
    const std::uint32_t pixel = row() / width_;
    for (std::uint32_t y = 0; y < height_; ++y) {
      std::uint8_t* to = bytes.data() + std::size_t{y} * (row() + padding);
      for (std::uint32_t x = 0; x < width_; ++x) {
        const std::uint8_t value = x == bar_of(number) ? kBright : kDark;
        for (std::uint32_t i = 0; i < pixel; ++i)
          to[pixel * x + i] = code_ == V4L2_PIX_FMT_YUYV && i == 1 ? kNoColour : value;
      }
    }
    return (row() + padding) * height_;
  }

  bool plugged_ = true, streaming_ = false;
  int last_ = 99, alive_ = -1, descriptors_ = 0, mapped_ = 0;
  std::uint32_t code_ = V4L2_PIX_FMT_YUYV, width_ = 16, height_ = 8;
  v4l2_fract period_{1, 30};
  std::vector<std::vector<std::uint8_t>> memory_;
  std::deque<std::uint32_t> queued_;
  std::deque<v4l2_buffer> done_;
  std::uint32_t sequence_ = 0;
  std::uint64_t time_us_ = 5'000'000;
};

}  // namespace verp::test
