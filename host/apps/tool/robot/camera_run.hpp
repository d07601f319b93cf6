#pragma once
#include <string>

#include "host/os/link/video_calls.hpp"

namespace verp::tool {

struct CameraWords {
  std::string device = "/dev/video0";
  std::string size, format, picture, record;
  double rate_hz = 0;  ///< 0: the camera's setting
  double seconds = 2;
  bool list = false, json = false, compress = false;
};

/// Returns the exit status. Throws ToolError, LinkError, TraceError, ReportError.
int run_camera(const CameraWords& words, link::VideoCalls& calls = link::kernel_video_calls());

}  // namespace verp::tool
