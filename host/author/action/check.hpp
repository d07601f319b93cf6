#pragma once
#include <string>
#include <vector>

#include "host/author/action/compile.hpp"
#include "host/robot/model/entity.hpp"

/// Checks an action without a world: the core's player runs it from the stand and back; conditions
/// come true, and carrying feet do not move.
namespace verp::action {

/// Check of the way to a key frame, and of its rest.
struct FrameCheck {
  int frame = 0;  ///< -1: the way back to the stand
  int line = 0;   ///< in the action's file
  double begin_s = 0, end_s = 0;
  double speed_share = 0;   ///< of the joint's limit
  std::string fastest;      ///< the joint of speed_share
  double torque_share = 0;  ///< of stall torque, weight alone
  std::string hardest;
  double zmp_margin_m = 1;  ///< inside the carrying soles; 1: none carries
  std::string problem;      ///< first broken bound; or empty
};

struct ActionCheck {
  std::vector<FrameCheck> frames;  ///< in the order played
  double length_s = 0;
  bool whole = true;  ///< false: stopped at length_s
  const FrameCheck* first_bad() const;
};

ActionCheck check(const model::Entity& entity, const Params& params, const CompiledActions& made,
                  int number);

}  // namespace verp::action
