#pragma once
#include <optional>
#include <string>
#include <vector>

#include "host/author/import/servos.hpp"
#include "host/robot/model/entity.hpp"
#include "host/robot/model/xml_source.hpp"

/// A foreign robot's file as a tree of links: enough to find its limbs. SI units; the frame of the
/// root link at the zero pose, z up.
namespace verp::import {

using model::Transform;
using model::Vec3;

struct Bone {
  enum class Kind { kTurns, kSlides, kFixed } kind = Kind::kFixed;
  std::string name;  ///< of the joint
  int parent = -1;   ///< index of a link
  int child = -1;
  Transform pose = Transform::Identity();  ///< of the joint's frame
  Vec3 axis = Vec3::UnitX();
  double lower_rad = 0, upper_rad = 0;  ///< lower > upper: not given
  bool has_no_stops = false;            ///< a continuous joint
  std::string follows;                  ///< the joint that it mimics; empty: none
  std::optional<Drive> drive;           ///< its motor, where the file says it
  Drive limit;                          ///< URDF's <limit effort velocity>
  bool has_friction = false;            ///< or damping, of the joint
};

struct LinkPart {
  std::string name;
  double mass_kg = 0;
  double radius_m = 0;  ///< of gyration: root of the largest moment over mass
  bool is_no_body =
      false;  ///< its moments: one is not positive, or larger than the sum of the others
  Transform pose = Transform::Identity();
  bool has_shape = false;         ///< seen or touched
  bool has_contact = false;       ///< any <collision>
  bool has_mesh_contact = false;  ///< one of them is a mesh
  bool has_imu = false;
  int above = -1;  ///< index of the bone that carries it; -1: the root
};

struct Skeleton {
  std::string name;
  std::vector<LinkPart> links;
  std::vector<Bone> bones;
  int root = 0;
  /// Sensors that the twin cannot have: a lidar that scans in several planes, a force-torque sensor
  /// in a fixed joint.
  std::vector<std::string> sensors_to_drop;

  double mass_kg() const;
  /// Turning bones from the root to this link.
  std::vector<int> turning_to(int link) const;
  /// Links that hang on this one by any bones, itself included.
  std::vector<int> hanging_on(int link) const;
};

/// Throws LoadError at the element for what is no tree: an unknown link, a second root, a loop.
Skeleton skeleton_of_urdf(const model::XmlElement& robot);

}  // namespace verp::import
