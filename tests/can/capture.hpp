#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/process/child.hpp"

/// What can-utils hear on an interface, and what tshark reads in it.
namespace verp::test {

/// A frame as tshark's CANopen dissector tells it; empty members: it tells none.
struct Decoded {
  std::uint32_t id = 0;
  std::string info;  ///< in its words: "SYNC [1]", "PDO1 (tx)", "EMCY" ...
  std::optional<std::uint32_t> node, sync, command, commanded, state, error_code, error_register,
      index, subindex, abort_code;
  std::vector<std::uint8_t> data;  ///< of a PDO, an SDO, or a frame that is none of CANopen's

  bool is(const char* words) const { return info.rfind(words, 0) == 0; }
  /// `bytes` of the data from `place` on, little-endian.
  std::uint32_t value(std::size_t place, std::size_t bytes) const;
};

/// candump, from when this is made until decode(); the log is in candump's own format.
class Capture {
 public:
  Capture(const std::filesystem::path& folder, std::string interface = "vcan0");

  /// Waits until the log has `text`, which is in candump's words: "613#40".
  void await(const std::string& text) const;
  /// Ends it; what it heard, frame by frame.
  std::vector<Decoded> decode();

 private:
  /// Sends a frame that is nobody's until the log has it.
  void await_marker(const char* frame) const;

  std::string interface_;
  std::filesystem::path log_, table_;
  process::Child candump_;
};

}  // namespace verp::test
