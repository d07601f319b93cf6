#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/boards/board/emulated_board.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/os/process/child.hpp"

namespace verp::board {

/// One image in QEMU; it ends with this object or this process.
class QemuProcess {
 public:
  struct Launch {
    EmulatedBoard board;
    std::filesystem::path image;
    std::vector<std::string> arguments;  ///< no spaces, no commas
    std::string plugin = {};             ///< -plugin; empty: none
    /// Socket paths where QEMU listens, in order of the board's serial ports.
    std::vector<std::filesystem::path> serial_ports = {};
    std::vector<std::string> options = {};
    std::string console = {};  ///< character device for output; empty: stdout
    /// This PC's interface for the board's CAN; empty: none.
    std::string can_interface = {};
  };

  static std::vector<std::string> command(const Launch& launch);

  /// Throws BoardError without QEMU; $VERP_QEMU names another emulator.
  explicit QemuProcess(const Launch& launch);

  /// The status after its end; 128 + signal if killed.
  std::optional<int> poll_status() { return child_->status(); }

  /// Waits for the end. Throws BoardError with the last output after `limit`.
  int wait(std::chrono::seconds limit);

  /// Throws BoardError with the last output unless the status is 0.
  void wait_for_success(std::chrono::seconds limit);

  std::string output() const;

  /// One line: the image, `what` happened to it, its last output.
  std::string described(const std::string& what) const;

 private:
  std::string name_;
  TemporaryDirectory directory_;
  std::optional<process::Child> child_;
};

}  // namespace verp::board
