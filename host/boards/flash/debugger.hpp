#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/boards/flash/emulation.hpp"

/// Command lines for gdb on a board's firmware. gdb starts QEMU or OpenOCD itself and talks to it
/// through a pipe. So no port is used, and no process remains afterwards. All functions throw
/// FlashError, NoSuchBoard and BoardError.
namespace verp::flash {

struct DebugPlan {
  std::vector<std::string> command;      ///< gdb and its arguments
  std::vector<EmulatedLink> links = {};  ///< where a twin finds the board
};

/// Debugs the flashed loop on the chip behind a debug probe, stopped at its start. `probe`: serial
/// number of the probe; empty: the only one.
DebugPlan debug_chip(const std::string& gdb, const Recipe& recipe, BusProtocol protocol,
                     const std::string& probe);

/// Debugs the loop on an emulated board with serial ports, stopped at its start.
DebugPlan debug_emulation(const std::string& gdb, const EmulationPlan& plan,
                          const std::filesystem::path& folder);

/// Debugs the controller on an emulated board over recorded inputs, stopped at the input `index`.
/// Job and result are files in `folder`.
DebugPlan debug_replay(const std::string& gdb, const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, std::uint32_t index,
                       const std::filesystem::path& folder);

}  // namespace verp::flash
