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

struct FlashOptions {
  std::string board, port, tool;
  std::string params;   ///< a Params image, or a robot to make it from; empty: none
  std::string bus;      ///< empty: the robot's first; selects the image
  std::string actions;  ///< a file; empty: the robot's; "none": not written
  std::string sensor;   ///< "sensor", "foot": the robot's IMU or foot; empty: its controller
  bool code = true;     ///< write the firmware
  bool emulate = false;
  bool dry_run = false;
  bool stay = true;  ///< an emulated board runs until an interrupt; false: until it is up
};

void declare_target(CLI::App& app, FlashOptions& options);

struct FlashAnswer {
  std::string text;
  cli::Json json;
};

/// The bus protocol selects the firmware.
BusProtocol bus_of(const FlashOptions& options, const flash::Recipe& recipe,
                   const std::filesystem::path& folder);

/// Plans an emulated board with the robot in its memory and its links in `folder`.
flash::EmulationPlan emulation_of(const FlashOptions& options, const flash::Recipe& recipe,
                                  const std::filesystem::path& folder);

/// Checks the files, then flashes, starts the emulated board, or (dry run) prints the commands.
/// `say` receives an emulated board's links early. Throws FlashError, LoadError, BoardError,
/// DeviceError.
FlashAnswer flash_board(const FlashOptions& options, cli::Progress& progress,
                        const std::function<void(const std::string&)>& say);

}  // namespace verp::tool
