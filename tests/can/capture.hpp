#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/os/process/child.hpp"

namespace verp::test {

struct Decoded {
  std::uint32_t id = 0;
  std::string info;  ///< "SYNC [1]", "PDO1 (tx)", "EMCY" ...
  std::optional<std::uint32_t> node, sync, command, commanded, state, error_code, error_register,
      index, subindex, abort_code;
  std::vector<std::uint8_t> data;  ///< of a PDO, an SDO, or a frame outside CANopen

  bool is(const char* words) const { return info.rfind(words, 0) == 0; }
  /// Little-endian, from `place` on.
  std::uint32_t value(std::size_t place, std::size_t bytes) const;
};

class Capture {
 public:
  Capture(const std::filesystem::path& folder, std::string interface = "vcan0");

  /// In candump's notation: "613#40".
  void await(const std::string& text) const;
  std::vector<Decoded> decode();

 private:
  /// Sends an unused frame until the log has it.
  void await_marker(const char* frame) const;

  std::string interface_;
  std::filesystem::path log_, table_;
  process::Child candump_;
};

}  // namespace verp::test
