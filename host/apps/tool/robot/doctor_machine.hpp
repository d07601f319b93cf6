#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/os/link/can_interface.hpp"

namespace verp::tool {

struct RunningProgram {
  int id = 0;
  std::string name;     ///< at most 15 characters, as the kernel keeps it
  std::string command;  ///< as typed
};

/// Reads facts of a PC and changes none. A test gives a folder in place of / and an environment.
/// Paths are absolute, as on the PC. Nothing throws: what cannot be read is empty or false.
class Machine {
 public:
  using Environment = std::map<std::string, std::string>;

  /// This PC.
  Machine();
  Machine(std::filesystem::path root, const Environment& environment);
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  std::filesystem::path at(const std::string& path) const { return root_.string() + path; }
  bool exists(const std::string& path) const;
  std::string read(const std::string& path) const;
  /// Without the line break.
  std::string first_line(const std::string& path) const;
  /// Paths in `folder` whose names begin so, sorted.
  std::vector<std::string> list(const std::string& folder, const std::string& begin = "") const;

  /// "$USER" if the system does not know it.
  std::string user() const;
  /// May this program read and write there?
  bool may_use(const std::string& path) const;
  /// How the user may get the rights of the file's group.
  std::string how_to_join(const std::string& path) const;

  /// Without this one.
  std::vector<RunningProgram> programs() const;
  /// Those that have `device` open. Programs of other users show it only to root.
  std::vector<RunningProgram> holders(const std::string& device) const;

  std::string current_folder;
  /// Value of an environment variable; empty: it is not set.
  std::function<std::string(const std::string& name)> variable;
  std::function<std::vector<link::CanInterface>()> interfaces = link::network_interfaces;
  std::function<std::optional<std::uint64_t>(const std::string& folder)> free_bytes;

 private:
  /// Numbers after "Uid:" and the like.
  std::vector<long> own_numbers(const std::string& label) const;
  RunningProgram program(int id) const;
  /// The line of a file like /etc/passwd whose third field is `id`.
  std::vector<std::string> fields_of(const std::string& path, long id) const;

  std::filesystem::path root_;  ///< empty: this PC's
};

}  // namespace verp::tool
