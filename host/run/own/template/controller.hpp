#pragma once
#include "common/control/step.hpp"

/// NAME: the robot's own controller, plus a wave of the right arm. Called once per control tick, on
/// the PC and on a board: no heap, no exceptions, no files, and no clock but `in.tick`.
struct Controller {
  /// On entry, `out` is what the robot's own controller decided; on return, what you want. While
  /// the robot stands or walks your goals count, within the joints' ranges and speeds. Torque you
  /// may only take away: the safety table stays in force.
  void operator()(const verp::Params& params, const verp::State& state, const verp::Inputs& in,
                  verp::Outputs& out);

  float up = 0;         ///< arm: 0 as the robot has it, 1 fully raised
  float waved_rad = 0;  ///< phase of the wave
};
