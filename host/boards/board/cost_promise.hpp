#pragma once

/// Promised cost of a controller tick on one core. tests/bench and `verp bench` check it.
namespace verp::board {

inline constexpr const char* kPromisedBoard = "mps2_an386";  ///< Cortex-M4F
/// Mean and worst, with actions, falls and estimator.
inline constexpr double kMostInstructions = 30000;
inline constexpr double kMostInstructionsWorst = 45000;
inline constexpr double kMostInstructionsDigest = 5000;  ///< part of those above
inline constexpr double kMostStackBytes = 4096;          ///< by static analysis
inline constexpr double kMostStateBytes = 3072;          ///< hashed every tick
inline constexpr double kLeastLinkTicksPerS = 5000;      ///< without controller and physics
/// Of the round trips of two PC processes over pipes in the same run, so that a slow PC passes.
inline constexpr double kLeastLinkPercent = 25;
/// Any board with CAN, robot on vcan0, no physics.
inline constexpr double kLeastCanTicksPerS = 150;

}  // namespace verp::board
