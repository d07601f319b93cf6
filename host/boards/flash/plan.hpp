#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/boards/flash/memory_map.hpp"
#include "host/boards/flash/recipe.hpp"

/// Commands that write files to a board's flash, as data, so that `--dry-run` prints exactly what
/// runs.
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
  std::string port;  ///< stm32flash: serial port; others: serial number of probe or device
  std::vector<Piece> pieces;
  std::filesystem::path folder;  ///< an empty folder for data read from the chip
};

struct Step {
  enum class Kind {
    kCheckChip,  ///< read-only: checks that the right chip answers
    kRead,       ///< reads a sector of which a part must be kept
    kCompose,    ///< combines old and new contents
    kWrite,      ///< erases, writes and, if the tool can, verifies
    kReadBack,   ///< if the tool cannot verify
    kCompare,
  };
  Kind kind;
  std::string label;  ///< for people: the present action
  std::vector<std::string> command;
  std::filesystem::path file = {};  ///< kRead, kReadBack: the file that must exist then, `bytes`
                                    ///< long
  std::uint32_t bytes = 0;
  /// kWrite of a sector that was read: its other contents, and the files to save them in if the
  /// write fails.
  std::vector<Piece> neighbours = {};
  Span sectors = {};  ///< the erased region
};

/// Tool for a board and a port: the requested one, else stm32flash if the port is a path, else the
/// board's default. Throws FlashError if board, tool and port do not fit together.
Tool choose_tool(const Recipe& recipe, const std::string& asked, const std::string& port);

/// All steps in order. The chip erases whole sectors. If a piece shares its sector with another
/// region, the sector is read first and written back with the new piece. Throws FlashError for a
/// port or path that the tool would misread.
std::vector<Step> plan(const Job& job);

}  // namespace verp::flash
