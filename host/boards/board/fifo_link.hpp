#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>

#include "host/boards/board/qemu.hpp"
#include "host/boards/board/temporary_directory.hpp"

namespace verp::board {

/// Only a hung firmware takes longer, even on a busy PC.
inline constexpr std::chrono::seconds kStart{60};
inline constexpr std::chrono::milliseconds kSilence{120'000};

/// Two FIFOs that firmware in QEMU opens by semihosting: 15,000 round trips a second. Create it,
/// pass its paths to the image, then connect().
class FifoLink {
 public:
  FifoLink();
  ~FifoLink();
  FifoLink(const FifoLink&) = delete;
  FifoLink& operator=(const FifoLink&) = delete;

  std::filesystem::path to_board() const { return directory_.path() / "to_board"; }
  std::filesystem::path from_board() const { return directory_.path() / "from_board"; }

  /// Waits until the firmware opened both, to_board() first. Throws BoardError if it ends or
  /// exceeds `limit`.
  void connect(QemuProcess& firmware, std::chrono::seconds limit);

  /// Reads at least one byte, at most capacity; 0: the firmware closed. Throws BoardError after
  /// `limit`.
  std::size_t read_some(void* data, std::size_t capacity, std::chrono::milliseconds limit);
  /// Reads all bytes; false: the firmware closed first. Throws like read_some().
  bool read(void* data, std::size_t size, std::chrono::milliseconds limit);
  /// Writes all bytes; false: the firmware closed. Never raises SIGPIPE.
  bool write(const void* data, std::size_t size);
  void close_to_board();

 private:
  TemporaryDirectory directory_;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace verp::board
