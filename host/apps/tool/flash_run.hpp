#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "host/apps/cli/json.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/boards/flash/emulation.hpp"

namespace CLI {
class App;
}

namespace verp::tool {

/// The command line of `verp flash`, checked.
struct FlashOptions {
  std::string board, port, tool;
  std::string params;   ///< a Params image, or a robot of which one is made; empty: none
  std::string bus;      ///< of that robot, by name; empty: its first. It decides which image
  std::string actions;  ///< a file; empty: those of a robot that is made; "none": no others
  bool code = true;     ///< the firmware itself
  bool emulate = false;
  bool dry_run = false;
  bool stay = true;  ///< an emulated board runs until somebody interrupts; else only until it is up
};

void declare_target(CLI::App& app, FlashOptions& options);

/// What came of it, in text and for --json.
struct FlashAnswer {
  std::string text;
  cli::Json json;
};

/// The kind of bus that the options' robot is on, which decides which firmware.
BusProtocol bus_of(const FlashOptions& options, const flash::Recipe& recipe,
                   const std::filesystem::path& folder);

/// The emulated board with the robot that the options name in its memory, its links in `folder`.
flash::EmulationPlan emulation_of(const FlashOptions& options, const flash::Recipe& recipe,
                                  const std::filesystem::path& folder);

/// Checks the files, then flashes them, or starts the emulated board with them, or says with which
/// commands it would. `say` gets what must be read before the end: an emulated board's links.
/// Throws FlashError, LoadError, BoardError, DeviceError.
FlashAnswer flash_board(const FlashOptions& options, cli::Progress& progress,
                        const std::function<void(const std::string&)>& say);

}  // namespace verp::tool
