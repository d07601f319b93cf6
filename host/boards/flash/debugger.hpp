#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/boards/flash/emulation.hpp"

/// gdb on a board's firmware, as one command line: gdb itself starts what stands between it and the
/// core, QEMU or OpenOCD, and speaks with it through a pipe. So no port is taken, and nothing is
/// left behind when it ends. All throw FlashError, NoSuchBoard and BoardError.
namespace verp::flash {

struct DebugPlan {
  std::vector<std::string> command;      ///< gdb and its words
  std::vector<EmulatedLink> links = {};  ///< where a twin finds the board
};

/// The loop on the chip behind a debug probe, as it was flashed, stopped where it starts. `probe`:
/// its serial number, empty: there is one.
DebugPlan debug_chip(const std::string& gdb, const Recipe& recipe, BusProtocol protocol,
                     const std::string& probe);

/// The loop on an emulated board with serial ports, stopped where it starts.
DebugPlan debug_emulation(const std::string& gdb, const EmulationPlan& plan,
                          const std::filesystem::path& folder);

/// The controller on an emulated board, over these inputs, stopped where it takes the one of this
/// index. What goes in and comes out is in files of `folder`.
DebugPlan debug_replay(const std::string& gdb, const std::string& board, const Params& params,
                       std::span<const Inputs> inputs, std::uint32_t index,
                       const std::filesystem::path& folder);

}  // namespace verp::flash
