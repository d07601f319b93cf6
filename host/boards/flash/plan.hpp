#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/boards/flash/memory_map.hpp"
#include "host/boards/flash/recipe.hpp"

/// Commands as data, so that `--dry-run` prints exactly what runs.
namespace verp::flash {

struct Piece {
  std::string what;  ///< "code", "robot", "actions"
  std::filesystem::path file;
  Span region;
};

struct Job {
  const Recipe& recipe;
  MemoryMap map;
  Tool tool;
  std::string port;  ///< stm32flash: serial port; others: serial number
  std::vector<Piece> pieces;
  std::filesystem::path folder;  ///< an empty folder for data read from the chip
};

struct Step {
  enum class Kind {
    kCheckChip,  ///< read-only: checks that the right chip answers
    kRead,       ///< reads a sector of which a part is kept
    kCompose,    ///< combines old and new contents
    kWrite,      ///< erases, writes and, if the tool can, verifies
    kReadBack,
    kCompare,
  };
  Kind kind;
  std::string label;  ///< for people
  std::vector<std::string> command;
  std::filesystem::path file = {};  ///< kRead, kReadBack: must exist then, `bytes` long
  std::uint32_t bytes = 0;
  /// For kWrite of a sector that was read: its other contents, and files to save them in after a
  /// failure.
  std::vector<Piece> neighbours = {};
  Span sectors = {};  ///< the erased region
};

/// The requested one, else stm32flash if the port is a path, else the board's default. Throws
/// FlashError if they do not fit together.
Tool choose_tool(const Recipe& recipe, const std::string& asked, const std::string& port);

/// Steps in order. The chip erases whole sectors. A sector shared with another region is read first
/// and written back with the new piece. Throws FlashError for a port or path that the tool
/// misreads.
std::vector<Step> plan(const Job& job);

}  // namespace verp::flash
