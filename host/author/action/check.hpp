#pragma once
#include <string>
#include <vector>

#include "host/author/action/compile.hpp"
#include "host/robot/model/entity.hpp"

/// What an action asks of a robot, without a world: the core's own player runs it from the stand
/// and back, conditions come true, feet that carry stay where they are.
namespace verp::action {

/// Of one key frame: the way to it and its rest.
struct FrameCheck {
  int frame = 0;  ///< of the library; -1: the way back to the stand
  int line = 0;   ///< in the action's file
  double begin_s = 0, end_s = 0;
  double speed_share = 0;   ///< of the joint's limit
  std::string fastest;      ///< that joint
  double torque_share = 0;  ///< of the servo's stall torque, by weight alone
  std::string hardest;
  double zmp_margin_m = 1;  ///< inside the soles that carry; 1: none does
  std::string problem;      ///< the first that breaks a bound; empty: none
};

struct Checked {
  std::vector<FrameCheck> frames;  ///< in the order played
  double length_s = 0;
  bool whole = true;  ///< false: it goes on after length_s, where the check ended
  /// The first frame with a problem; null: there is none.
  const FrameCheck* first_bad() const;
};

Checked check(const model::Entity& entity, const Params& params, const Made& made, int number);

}  // namespace verp::action
