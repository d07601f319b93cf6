#pragma once
#include <string>
#include <vector>

#include "host/author/import/skeleton.hpp"

/// Finds limbs from the tree and its geometry alone; names do not matter.
namespace verp::import {

struct FoundLimb {
  std::string name;        ///< left_leg, right_leg, left_arm, right_arm, head, waist
  int tip = -1;            ///< link that the last joint moves
  std::vector<int> bones;  ///< turning ones, from the trunk or the waist to the tip
};

struct Body {
  int trunk = -1;  ///< link where the legs' chains part
  std::vector<FoundLimb> legs, others;
  Vec3 forward = Vec3::UnitX(), left = Vec3::UnitY();  ///< horizontal, root's frame
  std::vector<std::string> reasons;                    ///< of the guess of `forward`
  bool sure_of_forward = false;

  void turn_round();  ///< what was ahead is behind
};

/// The lowest tip of at least four turning joints in the zero pose is a foot; the tip that mirrors
/// it best is the other. Knees that bend one way tell what is ahead; else the file's x axis.
/// Throws LoadError where no two legs are found.
Body find_body(const Skeleton& skeleton, const model::XmlElement& at);

/// Joints of a leg by axes, as model::slots_of() takes them.
struct LegJoints {
  bool yaws = false, rolls = false;  ///< at the hip; at the ankle
  bool complete = false;             ///< all the others, and no more
  std::size_t hip_pitch = 2;         ///< its bone's index
};
LegJoints joints_of_leg(const Skeleton& skeleton, const Body& body, const FoundLimb& leg);

}  // namespace verp::import
