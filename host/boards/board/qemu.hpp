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

/// One run of a firmware image in QEMU. Ends with this object at the latest, and with this process.
class QemuProcess {
 public:
  struct Launch {
    EmulatedBoard board;
    std::filesystem::path image;
    std::vector<std::string>
        arguments;            ///< what the image gets as its command line; no spaces, no commas
    std::string plugin = {};  ///< QEMU's -plugin option; empty: none
    /// Where QEMU listens for the peers of the board's serial ports, in order: paths of sockets.
    std::vector<std::filesystem::path> serial_ports = {};
    std::vector<std::string> options = {};  ///< further words of QEMU's command line
    std::string console =
        {};  ///< QEMU's character device that gets what the image says; empty: stdout
    /// This PC's CAN interface that the board's CAN is joined to; empty: none.
    std::string can_interface = {};
  };

  /// The command line that a launch comes to.
  static std::vector<std::string> command(const Launch& launch);

  /// Throws BoardError if QEMU isn't installed. $VERP_QEMU names another emulator.
  explicit QemuProcess(const Launch& launch);

  /// The image's exit status, once it has one; 128 + signal if QEMU itself was killed.
  std::optional<int> poll_status() { return child_->status(); }

  /// Waits for the end. Throws BoardError with the image's last words if that takes too long.
  int wait(std::chrono::seconds limit);

  /// Throws BoardError with the image's last words if it ended with any status but 0.
  void wait_for_success(std::chrono::seconds limit);

  /// All that the image and QEMU printed so far.
  std::string output() const;

  /// One line: which image, what happened to it, its last words.
  std::string described(const std::string& what) const;

 private:
  std::string name_;
  TemporaryDirectory directory_;
  std::optional<process::Child> child_;
};

}  // namespace verp::board
