#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/author/mjcf/document.hpp"

/// A robot of an MJCF file, as far as a robot of VERP can have it. SI units; the file's frames.
namespace verp::mjcf {

struct Geom {
  enum class Kind { kBox, kSphere, kCylinder, kCapsule, kEllipsoid, kMesh } kind = Kind::kSphere;
  Vec3 size = Vec3::Zero();  ///< half of it; cylinder and capsule: radius, half length
  Transform pose = Transform::Identity();     ///< in the body
  std::string mesh;                           ///< its name
  double mass_kg = -1, density_kg_m3 = 1000;  ///< mass below 0: from the density
  bool is_seen = false, touches = false;
  double friction = 1;
  std::vector<double> rgba;
};

struct Site {
  std::string name;
  Transform pose = Transform::Identity();  ///< in the body
};

struct Inertial {
  Transform pose = Transform::Identity();  ///< in the body
  double mass_kg = 0;
  Mat3 inertia_kg_m2 = Mat3::Zero();
};

/// Our own name of a number in MJCF's <custom>; the joint's name follows.
inline constexpr const char* kNoLoad = "no_load_rad_s:";

/// Numbers of a joint and of the actuators that turn it.
struct Motor {
  bool has_actuator = false;
  double torque_n_m = 0;  ///< 0: not limited in the file
  double kp_n_m_rad = 0;
  double no_load_rad_s = 0;  ///< 0: not said; MJCF has no word for it (kNoLoad)
  double armature_kg_m2 = 0, damping_n_m_s = 0, friction_n_m = 0;
};

struct Joint {
  std::string name;
  bool slides = false;
  Vec3 at_m = Vec3::Zero(), axis = Vec3::UnitZ();  ///< in the body
  bool has_stops = false;
  double lower = 0, upper = 0;  ///< rad, or m
  double start = 0;             ///< in the pose that the file describes
  Motor motor = {};
};

struct Body {
  std::string name;
  int parent = -1;
  Transform pose = Transform::Identity();  ///< in the parent
  std::optional<Inertial> inertial;
  std::vector<Joint> joints;
  std::vector<Geom> geoms;
  std::vector<Site> sites;  ///< soles and IMU, for a writer
  bool has_imu = false;
};

struct Mesh {
  std::string file;  ///< from the working directory
  Vec3 scale = Vec3::Ones();
};

/// first = offset + factor * second.
struct Follower {
  std::string first, second;
  double offset = 0, factor = 1;
};

struct Robot {
  std::string name;
  std::vector<Body> bodies;  ///< a parent comes before its children; the first is the trunk's root
  std::map<std::string, Mesh> meshes;
  std::vector<Follower> followers;
  std::vector<std::pair<std::string, std::string>> apart;  ///< bodies that never collide
  std::map<std::string, double> stand;                     ///< by joint: the keyframe of that name
  std::vector<std::string> left_out;                       ///< one line each
};

/// Throws LoadError at the element that cannot be understood.
Robot read_robot(const std::string& path);

/// A robot of VERP, for a writer.
Robot robot_of(const model::Entity& entity);

std::string mjcf_of(Robot& robot, const std::string& folder);

/// `folder`: of the URDF, for paths of meshes. Adds to `robot.left_out` what URDF cannot say.
std::string urdf_of(Robot& robot, const std::string& folder);

}  // namespace verp::mjcf
