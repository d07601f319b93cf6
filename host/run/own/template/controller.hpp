#pragma once
#include "common/control/step.hpp"

/// NAME: the robot's own controller, plus a wave of the right arm. Called once per control tick, on
/// the PC and on a board: no heap, no exceptions, no files, and no clock but `in.tick`.
struct Controller {
  /// On entry, `out` holds the previous tick's outputs; on return, the outputs to send.
  void operator()(const verp::Params& params, verp::State& state, const verp::Inputs& in,
                  verp::Outputs& out);

  float up = 0;         ///< arm: 0 as the robot has it, 1 fully raised
  float waved_rad = 0;  ///< phase of the wave
};
