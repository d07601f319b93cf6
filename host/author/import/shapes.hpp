#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

/// Where a link's shapes are, at the zero pose in the body's frame.
namespace verp::import {

using model::Vec3;

/// Corners of contact shapes without meshes; if there are none, of what is seen, meshes included.
/// Empty: the link has no shape, or its meshes are missing.
std::vector<Vec3> points_of(const model::Entity& entity, int node);

struct Sole {
  model::Transform pose = model::Transform::Identity();  ///< its centre; z is up from the floor
  double length_m = 0, width_m = 0;
  bool measured = true;  ///< false: no shape, guessed from the leg's length
};

/// The bounding box of the points within 4 mm of the lowest; within more where these are no sole.
/// Where a level floor finds none, the foot is not level at the file's zero: then the tilt, up to
/// 30 degrees ahead and 20 aside, that makes the largest sole. Soles of 0.08 of the leg come before
/// narrower ones, of 0.03: a round edge looks like those.
Sole sole_of(const model::Entity& entity, int foot, double leg_m);

/// Nodes but the feet whose contact shapes reach below the soles: they would carry the robot.
std::vector<std::string> reach_below(const model::Entity& entity, const std::vector<int>& feet,
                                     const std::vector<Sole>& soles);

}  // namespace verp::import
