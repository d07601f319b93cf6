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

/// One run of a firmware image in QEMU. It ends at the latest with this object or this process.
class QemuProcess {
 public:
  struct Launch {
    EmulatedBoard board;
    std::filesystem::path image;
    std::vector<std::string> arguments;  ///< command line of the image; no spaces, no commas
    std::string plugin = {};             ///< QEMU's -plugin option; empty: none
    /// Socket paths on which QEMU listens for the peers of the board's serial ports, in order.
    std::vector<std::filesystem::path> serial_ports = {};
    std::vector<std::string> options = {};
    std::string console = {};  ///< QEMU character device for the image's output; empty: stdout
    /// CAN interface of this PC to which the board's CAN is connected; empty: none.
    std::string can_interface = {};
  };

  static std::vector<std::string> command(const Launch& launch);

  /// Throws BoardError if QEMU is not installed. $VERP_QEMU names another emulator.
  explicit QemuProcess(const Launch& launch);

  /// Exit status of the image after its end; 128 + signal if QEMU was killed.
  std::optional<int> poll_status() { return child_->status(); }

  /// Waits for the end. Throws BoardError with the image's last output if that takes too long.
  int wait(std::chrono::seconds limit);

  /// Throws BoardError with the image's last output if it ended with a nonzero status.
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
