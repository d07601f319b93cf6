#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"

/// Scene, and one instant of it (snapshot.hpp), for all displays. Without physics or controller.
namespace verp::scene {

using model::Entity;
using model::Mat3;
using model::Transform;
using model::Vec3;

/// sRGB and opacity, 0 to 1.
struct Colour {
  float r = 1, g = 1, b = 1, a = 1;
};

struct Material {
  Colour colour;
  float roughness = 0.55F;
  float metallic = 0;
  Colour glow{0, 0, 0, 1};
  std::string texture = {};  ///< times the colour; may be empty
};

/// Item's frame, metres; without normals faces are flat.
struct Triangles {
  std::vector<Eigen::Vector3f> points, normals;
  std::vector<Eigen::Vector2f> texture_at;  ///< empty: no texture
  std::vector<std::uint32_t> indices;       ///< three per triangle
};

enum class Shape {
  kBox,       ///< size: edges
  kSphere,    ///< size.x: radius
  kCapsule,   ///< size.x: radius, size.z: between the caps' centres, along z
  kCylinder,  ///< size.x: radius, size.z: length
  kPlane,     ///< size.x, size.y: edges; faces z
  kMesh,      ///< mesh_file; size: scale per axis
  kTriangles  ///< of `triangles`
};

inline constexpr int kWorld = -1;

/// A shape on a link or in the world.
struct Item {
  std::string name;
  int robot = kWorld;  ///< index into Scene::robots
  /// Link; in the world, index into Snapshot::body_world, or kWorld if fixed.
  int node = 0;
  Transform pose = Transform::Identity();  ///< frame of `node`
  Shape shape = Shape::kBox;
  Vec3 size_m = Vec3::Zero();
  double round_m = 0;  ///< edge radius of a box or cylinder
  Material material;
  std::string mesh_file;
  std::shared_ptr<const Triangles> triangles;
  bool collision = false;  ///< drawn only with Effects::collisions
};

struct Light {
  enum class Kind { kSun, kPoint, kSpot } kind = Kind::kSun;
  Vec3 position_m = Vec3::Zero();
  Vec3 direction = Vec3(-0.4, 0.3, -1);  ///< of the light's rays
  Colour colour;
  float strength = 1;
  double range_m = 10;  ///< point, spot
  /// Point and spot at distance d: strength / (x + y d + z d^2), less near the range's end.
  Vec3 fading = Vec3(0.01, 0, 1);
  double inner_rad = 0.4, outer_rad = 0.6;
  bool shadows = false;  ///< only the first such sun casts them
};

struct Fog {
  bool on = false;
  Colour colour{0.8F, 0.83F, 0.87F, 1};
  double begin_m = 4, end_m = 30;  ///< linear between the two
  double density_1_m = 0;          ///< above 0: e^-(density d) remains at d
  bool squared = false;            ///< e^-(density d)^2
};

/// A soft gradient; smooth surfaces mirror it.
struct Sky {
  Colour zenith{0.62F, 0.72F, 0.84F, 1};
  Colour horizon{0.93F, 0.945F, 0.96F, 1};
};

/// z = 0; fades into the horizon.
struct Ground {
  bool on = true;
  Colour light{0.80F, 0.815F, 0.835F, 1};
  Colour dark{0.775F, 0.79F, 0.812F, 1};
  Colour line{0.64F, 0.66F, 0.70F, 1};
  double tile_m = 0.1;
  double fade_m = 6;  ///< at this distance it is half horizon
};

/// A camera from a file; in the world, robot is kWorld.
struct Mount {
  std::string name;
  int robot = 0, node = 0;
  Transform pose = Transform::Identity();  ///< x ahead, z up
  double horizontal_fov_rad = 1.0472;
  int width_px = 320, height_px = 240;
  double near_m = 0.02, far_m = 20;
};

struct Robot {
  std::string name;
  std::shared_ptr<const Entity> entity;
  double height_m = 0.5;  ///< standing
  /// The box around what is drawn of it; x ahead, y left of the body's centre, z above the floor.
  Eigen::AlignedBox3d drawn_m = Eigen::AlignedBox3d(Vec3(0, 0, 0), Vec3(0, 0, 0));
};

struct Scene {
  std::vector<Robot> robots;
  std::vector<Item> items;
  std::vector<Light> lights;
  Colour ambient{1, 1, 1, 1};
  float ambient_strength = 0.42F;
  Fog fog;
  Sky sky;
  Ground ground;
  bool antialias = true, textures = true, transparency = true;  ///< left on by its file
  std::vector<Mount> cameras;
  std::vector<std::string> notes;  ///< missing files, one line a robot
};

/// Value in a segmentation picture. Links count from 1, by robot and link; then things, where
/// consecutive items of one name share a value. 0: nothing or floor.
int label_of(const Scene& scene, const Item& item);
/// ROBOT/LINK, or the item's.
std::string label_name(const Scene& scene, int label);

}  // namespace verp::scene
