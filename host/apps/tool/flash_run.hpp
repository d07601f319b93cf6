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

/// The checked command line of `verp flash`.
struct FlashOptions {
  std::string board, port, tool;
  std::string params;   ///< a Params image, or a robot to make it from; empty: none
  std::string bus;      ///< name of the robot's bus; empty: its first. Selects the image
  std::string actions;  ///< a file; empty: those of the robot; "none": do not write any
  bool code = true;     ///< write the firmware
  bool emulate = false;
  bool dry_run = false;
  bool stay = true;  ///< run an emulated board until an interrupt; false: only until it is up
};

void declare_target(CLI::App& app, FlashOptions& options);

/// The outcome, as text and for --json.
struct FlashAnswer {
  std::string text;
  cli::Json json;
};

/// The bus protocol of the robot in `options`; it selects the firmware.
BusProtocol bus_of(const FlashOptions& options, const flash::Recipe& recipe,
                   const std::filesystem::path& folder);

/// Plans an emulated board with the robot of `options` in its memory and its links in `folder`.
flash::EmulationPlan emulation_of(const FlashOptions& options, const flash::Recipe& recipe,
                                  const std::filesystem::path& folder);

/// Checks the files, then flashes them, starts the emulated board, or (dry run) prints the
/// commands. `say` receives what the user needs before the end: an emulated board's links. Throws
/// FlashError, LoadError, BoardError, DeviceError.
FlashAnswer flash_board(const FlashOptions& options, cli::Progress& progress,
                        const std::function<void(const std::string&)>& say);

}  // namespace verp::tool
