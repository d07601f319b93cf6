#pragma once
#include <cstddef>
#include <cstdint>

namespace verp::link {

/// What is asked of the kernel for a video device, each as the call of that name: -1 (null of map)
/// and errno if it fails. The tests' device stands behind the same calls, as a kernel without a
/// camera has none.
class VideoCalls {
 public:
  virtual ~VideoCalls() = default;
  virtual int open(const char* path) = 0;  ///< to read and write, without waiting
  virtual void close(int descriptor) = 0;
  virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  virtual std::uint8_t* map(int descriptor, std::size_t size, std::int64_t offset) = 0;
  virtual void unmap(std::uint8_t* bytes, std::size_t size) = 0;
  /// Whether a picture is there: 1, or 0 after so long; -1 and errno.
  virtual int wait(int descriptor, int time_ms) = 0;
};

/// Those of the kernel.
VideoCalls& kernel_video_calls();

}  // namespace verp::link
