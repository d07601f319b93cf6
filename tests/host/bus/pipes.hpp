#pragma once
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "host/twin/bus/bus_server.hpp"

namespace verp::test {

class Pipe {
 public:
  Pipe() {
    if (::pipe(fd_.data()) != 0) throw std::runtime_error("no pipe");
  }
  ~Pipe() {
    close_write_end();
    ::close(fd_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int read_end() const { return fd_[0]; }
  int write_end() const { return fd_[1]; }
  void close_write_end() {
    if (fd_[1] >= 0) ::close(fd_[1]);
    fd_[1] = -1;
  }

 private:
  std::array<int, 2> fd_{-1, -1};
};

struct PipePair {
  Pipe from_controller;
  Pipe to_controller;
};

struct PipeEnd {
  std::size_t read_some(void* data, std::size_t capacity) {
    const ssize_t count = ::read(pipe.read_end(), data, capacity);
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  bool write(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    while (size > 0) {
      const ssize_t count = ::write(pipe.write_end(), bytes, size);
      if (count <= 0) return false;
      bytes += count;
      size -= static_cast<std::size_t>(count);
    }
    return true;
  }
  Pipe& pipe;
};

/// For a bus::BusServer at the other end.
inline bus::ByteStreams server_streams(PipePair& pipes) {
  return {
      .read_some = [end = PipeEnd{pipes.from_controller}](
                       void* data,
                       std::size_t capacity) mutable { return end.read_some(data, capacity); },
      .write = [end = PipeEnd{pipes.to_controller}](
                   const void* data, std::size_t size) mutable { return end.write(data, size); }};
}

}  // namespace verp::test
