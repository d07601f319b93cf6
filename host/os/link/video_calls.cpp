#include "host/os/link/video_calls.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace verp::link {
namespace {

class KernelVideoCalls final : public VideoCalls {
 public:
  int open(const char* path) override { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); }
  void close(int descriptor) override { ::close(descriptor); }
  int ioctl(int descriptor, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ::ioctl(descriptor, request, argument);
    } while (result < 0 && errno == EINTR);
    return result;
  }
  std::uint8_t* map(int descriptor, std::size_t size, std::int64_t offset) override {
    void* bytes = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
    return bytes == MAP_FAILED ? nullptr : static_cast<std::uint8_t*>(bytes);
  }
  void unmap(std::uint8_t* bytes, std::size_t size) override { ::munmap(bytes, size); }
  int wait(int descriptor, int time_ms) override {
    pollfd one{.fd = descriptor, .events = POLLIN, .revents = 0};
    const int count = ::poll(&one, 1, time_ms);
    return count < 0 && errno == EINTR ? 0 : count;
  }
};

}  // namespace

VideoCalls& kernel_video_calls() {
  static KernelVideoCalls calls;
  return calls;
}

}  // namespace verp::link
