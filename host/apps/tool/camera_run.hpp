#pragma once
#include <string>

#include "host/os/link/video_calls.hpp"

namespace verp::tool {

/// What a person asked `verp bus camera` for.
struct CameraWords {
  std::string device = "/dev/video0";
  std::string size, format, picture, record;
  double rate_hz = 0;  ///< 0: as it is
  double seconds = 2;
  bool list = false, json = false, compress = false;
};

/// Watches a camera of this PC; returns the exit status. Throws ToolError, LinkError, TraceError,
/// ReportError.
int run_camera(const CameraWords& words, link::VideoCalls& calls = link::kernel_video_calls());

}  // namespace verp::tool
