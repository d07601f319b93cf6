#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/twin/bus/bus_server.hpp"

namespace verp::board {

/// Runs the control loop in firmware on an emulated board, with `bus` as its servo bus, until the
/// firmware quits: after options.ticks, or when hooks.stop says so. All of the controller is there;
/// this process is its world. Throws BoardError when there is no image or emulator, or when the
/// link breaks. `images`: the folder of the board's image; empty: where this project's is.
bus::ServerResult run_loop_on(const std::string& board, const Params& params, bus::VirtualBus& bus,
                              const bus::ServerHooks& hooks, const bus::RunOptions& options,
                              const std::string& images = "");

}  // namespace verp::board
