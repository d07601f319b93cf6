#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/boards/flash/memory_map.hpp"
#include "host/boards/flash/recipe.hpp"

/// The commands that bring files into a board's flash. They are data: what `--dry-run` prints is
/// what runs.
namespace verp::flash {

/// A file for one region of the flash.
struct Piece {
  std::string what;  ///< "code", "robot", "actions"
  std::filesystem::path file;
  Span region;
};

struct Job {
  const Recipe& recipe;
  MemoryMap map;
  Tool tool;
  std::string port;  ///< stm32flash: the serial port; others: the probe's or device's serial number
  std::vector<Piece> pieces;
  std::filesystem::path folder;  ///< an empty one of our own, for what is read from the chip
};

struct Step {
  enum class Kind {
    kCheckChip,  ///< read-only: is somebody there, and is it the right chip?
    kRead,       ///< a sector that must keep a part of what it holds
    kCompose,    ///< of what was read and what is new
    kWrite,      ///< erase, write and, where the tool can, verify
    kReadBack,   ///< where the tool can't
    kCompare,
  };
  Kind kind;
  std::string label;  ///< for people: what goes on
  std::vector<std::string> command;
  std::filesystem::path file = {};  ///< kRead, kReadBack: what must then be there, `bytes` long
  std::uint32_t bytes = 0;
  /// kWrite of a sector that was read: what else is in it, and where to keep that if this fails.
  std::vector<Piece> neighbours = {};
  Span sectors = {};  ///< kWrite: what is erased
};

/// The tool for a board and a port: the one asked for, else stm32flash for a path, else the board's
/// usual one. Throws FlashError when the board has no such way, the way needs a port, or the port
/// is of another way.
Tool choose_tool(const Recipe& recipe, const std::string& asked, const std::string& port);

/// All of it in order. A sector is erased as a whole: where a piece shares one with another region,
/// the sector is read first and written back with the new piece in it. Throws FlashError for a port
/// or path that the tool would take for something else.
std::vector<Step> plan(const Job& job);

}  // namespace verp::flash
