#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/twin/bus/bus_server.hpp"

namespace verp::board {

/// Runs the loop on an emulated board with `bus` as servo bus, for options.ticks or until
/// hooks.stop. Throws BoardError without image or emulator, or on a broken link. `images`: empty:
/// the project's.
bus::ServerResult run_loop_on(const std::string& board, const Params& params, bus::VirtualBus& bus,
                              const bus::ServerHooks& hooks, const bus::RunOptions& options,
                              const std::string& images = "");

}  // namespace verp::board
