#pragma once
#include <string>

#include "common/model/params.hpp"
#include "host/twin/bus/bus_server.hpp"

namespace verp::board {

/// Runs the control loop in firmware on an emulated board with `bus` as its servo bus, until
/// options.ticks have passed or hooks.stop returns true. This process simulates only the world.
/// Throws BoardError if the image or emulator is missing or the link breaks. `images`: folder of
/// the board's image; empty: the project's.
bus::ServerResult run_loop_on(const std::string& board, const Params& params, bus::VirtualBus& bus,
                              const bus::ServerHooks& hooks, const bus::RunOptions& options,
                              const std::string& images = "");

}  // namespace verp::board
