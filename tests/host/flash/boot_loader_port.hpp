#pragma once
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/support/rom_boot_loader.hpp"

/// A pseudo-terminal has no parity, so the tool's 8E1 is not checked.
namespace verp::test {

class BootLoaderPort {
 public:
  struct Trouble {
    std::uint32_t cut_after_writes = 0;  ///< the next write is cut midway
    std::uint32_t byte_us = 0;
    bool mute = false;
  };

  /// The chip must outlive this.
  explicit BootLoaderPort(RomBootLoader& chip) : BootLoaderPort(chip, Trouble{}) {}
  BootLoaderPort(RomBootLoader& chip, const Trouble& trouble) : chip_(chip), trouble_(trouble) {
    char name[64];
    if (::openpty(&ours_, &theirs_, name, nullptr, nullptr) != 0) std::abort();
    // A child's copy would keep the port alive after the cut.
    for (const int end : {ours_, theirs_}) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    termios settings{};
    ::tcgetattr(theirs_, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(theirs_, TCSANOW, &settings);
    path_ = name;
    thread_ = std::thread([this] { serve(); });
  }
  ~BootLoaderPort() { unplug(); }
  BootLoaderPort(const BootLoaderPort&) = delete;
  BootLoaderPort& operator=(const BootLoaderPort&) = delete;

  const std::string& path() const { return path_; }
  std::uint32_t writes() const { return writes_; }
  void unplug() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void serve() {
    std::vector<std::uint8_t> reply;
    while (!over_) {
      pollfd waiting{.fd = ours_, .events = POLLIN, .revents = 0};
      std::uint8_t byte = 0;
      if (::poll(&waiting, 1, 10) <= 0 || ::read(ours_, &byte, 1) != 1) continue;
      if (trouble_.mute) continue;
      if (trouble_.byte_us > 0) {
        std::this_thread::sleep_for(std::chrono::microseconds(trouble_.byte_us));
      }
      reply.clear();
      chip_.take(byte, reply);
      writes_ = chip_.writes;
      if (trouble_.cut_after_writes > 0 && chip_.writes >= trouble_.cut_after_writes &&
          ++bytes_since_ > 100) {
        break;
      }
      if (!reply.empty() && ::write(ours_, reply.data(), reply.size()) < 0) break;
    }
    ::close(theirs_);
    ::close(ours_);
  }

  RomBootLoader& chip_;
  const Trouble trouble_;
  std::string path_;
  int ours_ = -1, theirs_ = -1;
  int bytes_since_ = 0;
  std::atomic<bool> over_ = false;
  std::atomic<std::uint32_t> writes_ = 0;
  std::thread thread_;
};

}  // namespace verp::test
