#pragma once
#include <cstddef>
#include <cstdint>

namespace verp::link {

/// Like the system calls: -1 (map: null) and errno on failure. Tests replace them: their kernel has
/// no camera.
class VideoCalls {
 public:
  virtual ~VideoCalls() = default;
  virtual int open(const char* path) = 0;  ///< non-blocking
  virtual void close(int descriptor) = 0;
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  virtual std::uint8_t* map(int descriptor, std::size_t size, std::int64_t offset) = 0;
  virtual void unmap(std::uint8_t* bytes, std::size_t size) = 0;
  /// 1: a picture; 0: timeout; -1: errno.
  virtual int wait(int descriptor, int time_ms) = 0;
};

VideoCalls& kernel_video_calls();

}  // namespace verp::link
