#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>

#include "host/boards/board/qemu.hpp"
#include "host/boards/board/temporary_directory.hpp"

namespace verp::board {

/// Limits that end only a hung firmware, even on a busy PC: otherwise it starts and answers at
/// once.
inline constexpr std::chrono::seconds kStart{60};
inline constexpr std::chrono::milliseconds kSilence{120'000};

/// Two FIFOs that firmware in QEMU opens by semihosting: a byte stream each way, 15,000 round trips
/// a second. Create it first, pass its paths to the image, then call connect(). The firmware opens
/// to_board() first.
class FifoLink {
 public:
  FifoLink();
  ~FifoLink();
  FifoLink(const FifoLink&) = delete;
  FifoLink& operator=(const FifoLink&) = delete;

  std::filesystem::path to_board() const { return directory_.path() / "to_board"; }
  std::filesystem::path from_board() const { return directory_.path() / "from_board"; }

  /// Waits until the firmware has opened both. Throws BoardError if the firmware ends first or
  /// exceeds `limit`.
  void connect(QemuProcess& firmware, std::chrono::seconds limit);

  /// Waits for at least one byte; returns the number of bytes, at most capacity; 0: the firmware
  /// closed its end. Throws BoardError if nothing arrives within `limit`.
  std::size_t read_some(void* data, std::size_t capacity, std::chrono::milliseconds limit);
  /// Reads all bytes; false if the firmware closed its end first. Throws like read_some().
  bool read(void* data, std::size_t size, std::chrono::milliseconds limit);
  /// Writes all bytes; false if the firmware closed its end. Never raises SIGPIPE.
  bool write(const void* data, std::size_t size);
  void close_to_board();

 private:
  TemporaryDirectory directory_;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace verp::board
