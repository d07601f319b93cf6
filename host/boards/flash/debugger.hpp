#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/boards/flash/emulation.hpp"

/// gdb starts QEMU or OpenOCD itself and talks through a pipe: no port, and no process remains.
/// Throws FlashError, NoSuchBoard and BoardError.
namespace verp::flash {

struct DebugPlan {
  std::vector<std::string> command;      ///< gdb and its arguments
  std::vector<EmulatedLink> links = {};  ///< where a twin finds the board
};

/// The flashed loop behind a debug probe, stopped at its start. `probe`: serial number; empty: the
/// only one.
DebugPlan debug_chip(const std::string& gdb, const Recipe& recipe, BusProtocol protocol,
                     const std::string& probe);

/// The loop with serial ports, stopped at its start.
DebugPlan debug_emulation(const std::string& gdb, const EmulationPlan& plan,
                          const std::filesystem::path& folder);

/// The controller over recorded inputs, stopped at input `index`. Job and result are in `folder`.
DebugPlan debug_replay(const std::string& gdb, const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, std::uint32_t index,
                       const std::filesystem::path& folder);

}  // namespace verp::flash
