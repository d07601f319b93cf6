#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/author/import/limbs.hpp"
#include "host/author/import/shapes.hpp"

/// The robot.sdf that wraps a foreign file.
namespace verp::import {

struct ServoRow {
  int bone = -1;
  double lower_rad = 0, upper_rad = 0;
  std::string type;
};

/// In place of a link's moments, and of its mass if that is given.
struct Ball {
  std::string link;
  double radius_m = 0, mass_kg = 0;
};

struct Wrapper {
  std::string name, uri;  ///< of the model; of the wrapped file, from the wrapper's folder
  std::string protocol = "dynamixel2";
  std::vector<std::string> own_types;  ///< <verp:servo_type> elements
  bool drops_friction = false;         ///< of the file's joints
  std::vector<ServoRow> servos;        ///< joints that stay, ids from 1
  std::vector<int> fixed;              ///< bones that turn or slide in the file
  std::vector<std::string> dropped_mimics;
  std::vector<std::pair<std::string, double>> inertia_scales;  ///< by link; "*": all
  std::vector<Ball> balls;
  Transform body = Transform::Identity();  ///< root's frame
  std::vector<Sole> soles;                 ///< left, right, in the body's frame; empty: a probe
  std::vector<std::string> below_soles;    ///< links whose contacts are dropped
  std::optional<Eigen::AlignedBox3d> trunk_box;       ///< body's frame
  std::vector<std::pair<std::string, double>> stand;  ///< joints that cannot stand at zero
  std::vector<std::pair<std::string, double>> tuning;
};

/// The link of an IMU that the trunk carries; -1 if the file names no such link.
int imu_of(const Skeleton& skeleton, const Body& body);

/// Without soles: a text that loads as a part of a robot, to measure its shapes.
std::string text_of(const Wrapper& wrapper, const Skeleton& skeleton, const Body& body);

}  // namespace verp::import
