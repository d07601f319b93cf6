#pragma once
#include "common/control/step.hpp"

/// NAME: the robot's own controller, and a wave of the right arm on top of it. Called once a
/// control tick, on the PC and on a board: no heap, no exceptions, no files, no clock but
/// `in.tick`.
struct Controller {
  /// `out` holds what was sent in the tick before; what stands there afterwards is sent.
  void operator()(const verp::Params& params, verp::State& state, const verp::Inputs& in,
                  verp::Outputs& out);

  float up = 0;         ///< how far the arm is raised: 0 as the robot has it, 1 all the way
  float waved_rad = 0;  ///< where in the wave it is
};
