#include "host/boards/board/fifo_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>

#include "host/boards/board/board_error.hpp"

namespace verp::board {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* what) {
  throw BoardError(path.string() + ": " + what + " (" + std::strerror(errno) +
                   "); point TMPDIR at a file system that has FIFOs");
}

}  // namespace

FifoLink::FifoLink() {
  // A firmware that has ended gives EPIPE; the signal would end this process.
  signal(SIGPIPE, SIG_IGN);
  for (const auto& path : {to_board(), from_board()}) {
    if (mkfifo(path.c_str(), 0600) != 0) fail(path, "can't make a FIFO");
  }
  from_ = open(from_board().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (from_ < 0) fail(from_board(), "can't open");
}

FifoLink::~FifoLink() {
  close_to_board();
  close(from_);
}

void FifoLink::connect(QemuProcess& firmware, std::chrono::seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (to_ < 0) {
    to_ = open(to_board().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (to_ >= 0) break;
    if (errno != ENXIO) fail(to_board(), "can't open");
    if (firmware.poll_status()) firmware.wait_for_success(limit);
    if (std::chrono::steady_clock::now() > deadline) {
      throw BoardError("the emulated board doesn't open its link; rebuild its image");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  fcntl(to_, F_SETFL, 0);
}

std::size_t FifoLink::read_some(void* data, std::size_t capacity, std::chrono::milliseconds limit) {
  for (;;) {
    pollfd waiting{.fd = from_, .events = POLLIN, .revents = 0};
    const int ready = poll(&waiting, 1, static_cast<int>(limit.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      throw BoardError("the emulated board fell silent for " + std::to_string(limit.count()) +
                       " ms; its image may hang");
    }
    const ssize_t count = ::read(from_, data, capacity);
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR && errno != EAGAIN) fail(from_board(), "can't read");
  }
}

bool FifoLink::read(void* data, std::size_t size, std::chrono::milliseconds limit) {
  auto* bytes = static_cast<std::uint8_t*>(data);
  while (size > 0) {
    const std::size_t count = read_some(bytes, size, limit);
    if (count == 0) return false;
    bytes += count;
    size -= count;
  }
  return true;
}

bool FifoLink::write(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  while (size > 0) {
    const ssize_t count = ::write(to_, bytes, size);
    if (count < 0 && errno == EPIPE) return false;
    if (count < 0 && errno != EINTR) fail(to_board(), "can't write");
    if (count <= 0) continue;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

void FifoLink::close_to_board() {
  if (to_ >= 0) close(to_);
  to_ = -1;
}

}  // namespace verp::board
