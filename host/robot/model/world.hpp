#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

/// A world on the PC (load_world.hpp), for twin and renderers. Double precision, SI units, z up.
/// Poses are in the frame of their comment.
namespace verp::model {

/// Red, green, blue, opacity: 0 to 1.
using Color = std::array<double, 4>;

struct Material {
  Color ambient{0.6, 0.6, 0.6, 1}, diffuse{0.6, 0.6, 0.6, 1}, specular{0.1, 0.1, 0.1, 1},
      emissive{0, 0, 0, 1};
  std::string texture;      ///< albedo map; empty: none
  double transparency = 0;  ///< 0 opaque to 1
};

/// Rows from -y to y, each from -x to x, about the origin.
struct Heightfield {
  int columns = 0, rows = 0;
  double size_x_m = 0, size_y_m = 0;
  std::vector<double> height_m;

  double at(int column, int row) const {
    return height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                    static_cast<std::size_t>(column)];
  }
};

/// Corners counter-clockwise from outside, in metres.
struct Mesh {
  std::string file;
  std::vector<Vec3> vertex_m;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

struct Shape {
  enum class Kind { kPlane, kBox, kSphere, kCylinder, kCapsule, kHeightfield, kMesh };
  Kind kind = Kind::kBox;
  /// Box: edges; sphere: x radius; cylinder, capsule: x radius, z length (capsule: without caps);
  /// plane: x and y edges drawn, normal z.
  Vec3 size_m = Vec3::Zero();
  std::shared_ptr<const Heightfield> heightfield;
  std::shared_ptr<const Mesh> mesh;  ///< convex, or static
};

struct ContactSurface {
  double friction = 1.0;
  double restitution = 0;    ///< of speed, 0 to 1
  double stiffness_n_m = 0;  ///< <ode><kp>; 0: rigid
  double damping_n_s_m = 0;  ///< <ode><kd>
};

struct WorldCollision {
  std::string name;
  Shape shape;
  Transform pose = Transform::Identity();  ///< in the object
  ContactSurface surface;
};

struct WorldVisual {
  std::string name;
  Shape shape;
  Transform pose = Transform::Identity();  ///< in the object
  Material material;
  bool casts_shadows = true;
};

/// A point on a moving obstacle's path; it pushes what is in its way. Constant speed between
/// waypoints.
struct Waypoint {
  double t_s = 0;
  Transform pose = Transform::Identity();  ///< in the world
};

/// One rigid object; links of a model become objects MODEL/LINK.
struct WorldObject {
  std::string name;
  int line = 0;                            ///< in the file
  Transform pose = Transform::Identity();  ///< initial, in the world
  enum class Kind { kStatic, kDynamic, kMoving } kind = Kind::kStatic;
  double mass_kg = 0;                 ///< dynamic ones
  Vec3 com_m = Vec3::Zero();          ///< in the object
  Mat3 inertia_kg_m2 = Mat3::Zero();  ///< about the centre of mass, object's axes
  std::vector<WorldCollision> collisions;
  std::vector<WorldVisual> visuals;
  std::vector<Waypoint> waypoints;  ///< at least two, rising times
  bool loops = false;               ///< repeats from the first waypoint
};

struct Light {
  enum class Kind { kDirectional, kPoint, kSpot } kind = Kind::kDirectional;
  std::string name;
  Transform pose = Transform::Identity();  ///< in the world
  Vec3 direction = -Vec3::UnitZ();         ///< in the world
  Color diffuse{1, 1, 1, 1}, specular{0.1, 0.1, 0.1, 1};
  double range_m = 10, constant = 1, linear_1_m = 0, quadratic_1_m2 = 0;
  double inner_rad = 0, outer_rad = 0, falloff = 0;  ///< of a spot
  bool casts_shadows = false;
};

struct Fog {
  enum class Kind { kLinear, kExponential, kSquared } kind = Kind::kLinear;
  Color color{1, 1, 1, 1};
  double start_m = 1, end_m = 100, density_1_m = 0.1;
};

/// The <include> of a robot's file.
struct WorldRobot {
  std::string name;
  std::string file;
  double x_m = 0, y_m = 0, yaw_rad = 0;
};

struct World {
  std::string name, file;
  Vec3 gravity_m_s2{0, 0, -9.80665};
  Color ambient{0.4, 0.4, 0.4, 1}, background{0.7, 0.7, 0.7, 1};
  bool shadows = true;
  bool sky = false;  ///< brighter background toward the horizon
  /// Rendering effects: <verp:effects> of <scene>.
  bool antialias = true, textures = true, transparency = true;
  std::optional<Fog> fog;
  std::vector<Light> lights;
  std::optional<Transform> view;     ///< <gui><camera>: x ahead, z up
  std::vector<WorldObject> objects;  ///< one of them holds the ground
  std::vector<WorldRobot> robots;
};

/// Objects that may leave their initial pose.
inline std::vector<const WorldObject*> moving(const World& world) {
  std::vector<const WorldObject*> out;
  for (const WorldObject& object : world.objects) {
    if (object.kind != WorldObject::Kind::kStatic) out.push_back(&object);
  }
  return out;
}

}  // namespace verp::model
