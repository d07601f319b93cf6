#pragma once
#include <memory>
#include <string>

#include "host/os/files/temporary_directory.hpp"
#include "host/os/process/child.hpp"
#include "host/show/render/renderer.hpp"

namespace verp::pictures {

/// Sends pictures to an ffmpeg process. The file appears when it is complete.
class Encoder {
 public:
  /// .mp4, .gif or .webp. Throws ToolError without ffmpeg.
  Encoder(const std::string& file, render::Size size, int frames_per_s);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Throws ToolError with ffmpeg's last line if it has ended.
  void add(const render::Image& image);
  void finish();

 private:
  [[noreturn]] void fail();

  const std::string file_, part_;
  files::TemporaryDirectory folder_;
  int pipe_ = -1;
  std::unique_ptr<process::Child> ffmpeg_;
};

}  // namespace verp::pictures
