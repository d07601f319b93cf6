#include "host/show/scene/build.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "host/robot/model/mesh_file.hpp"
#include "host/robot/model/principal.hpp"
#include "host/show/scene/looks.hpp"
#include "host/twin/sim/body.hpp"

namespace verp::scene {
namespace {

Vec3 extent(Shape shape, const Vec3& size_m) {
  switch (shape) {
    case Shape::kSphere:
      return Vec3::Constant(2 * size_m.x());
    case Shape::kCapsule:
      return {2 * size_m.x(), 2 * size_m.x(), size_m.z() + 2 * size_m.x()};
    case Shape::kCylinder:
      return {2 * size_m.x(), 2 * size_m.x(), size_m.z()};
    case Shape::kMesh:
      return Vec3::Constant(0.2);  // larger than any servo
    default:
      return size_m;
  }
}

/// In the item's frame. A mesh that cannot be read is as large as a servo.
Eigen::AlignedBox3d box_of(const Item& item) {
  Vec3 half_m = extent(item.shape, item.size_m) / 2;
  if (item.shape != Shape::kMesh) return {-half_m, half_m};
  half_m /= 4;
  try {
    const auto mesh = model::read_mesh_to_touch(item.mesh_file, item.size_m);
    Eigen::AlignedBox3d box;
    for (const Vec3& vertex : mesh->vertex_m) box.extend(vertex);
    return box;
  } catch (const std::runtime_error&) {
    return {-half_m, half_m};
  }
}

Shape shape_of(model::Visual::Shape shape) {
  constexpr Shape kShapes[] = {Shape::kBox, Shape::kSphere, Shape::kCapsule, Shape::kCylinder,
                               Shape::kMesh};
  return kShapes[static_cast<int>(shape)];
}

Shape shape_of(model::Collision::Shape shape) {
  constexpr Shape kShapes[] = {Shape::kBox, Shape::kSphere, Shape::kCapsule, Shape::kCylinder};
  return kShapes[static_cast<int>(shape)];
}

class RobotBuilder {
 public:
  RobotBuilder(Scene& scene, const Entity& entity, Meshes meshes)
      : scene_(scene), e_(entity), meshes_(meshes), robot_(static_cast<int>(scene.robots.size())) {}

  int build() {
    for (int node = 0; node < static_cast<int>(e_.nodes.size()); ++node) add_link(node);
    for (const model::CameraSensor& sensor : e_.cameras) add_camera(sensor);
    for (const model::Joint& joint : e_.joints) add_hub(joint);
    if (meshes_ == Meshes::kFromFiles) note_missing();
    const Eigen::AlignedBox3d drawn = drawn_m();
    scene_.robots.push_back({e_.name, std::make_shared<const Entity>(e_), drawn.max().z(), drawn});
    return robot_;
  }

 private:
  bool can_be_drawn(const model::Visual& visual) const {
    if (visual.shape != model::Visual::Shape::kMesh) return true;
    return meshes_ == Meshes::kFromFiles && !visual.mesh.empty();
  }

  /// One note a robot: many robots lack their meshes.
  void note_missing() {
    std::size_t count = 0;
    std::string first;
    for (const model::Node& node : e_.nodes) {
      for (const model::Visual& visual : node.visuals) {
        if (visual.shape != model::Visual::Shape::kMesh || !visual.mesh.empty()) continue;
        if (count++ == 0) first = "'" + visual.mesh_uri + "' of link '" + node.name + "'";
      }
    }
    if (count == 0) return;
    const std::string others = count == 1 ? "" : " and " + std::to_string(count - 1) + " more";
    scene_.notes.push_back(e_.name + ": there is no mesh " + first + others +
                           "; what collides is drawn instead. VERP_MODEL_PATH says where else to "
                           "look");
  }

  Item& add(int node, const std::string& name, Shape shape, const Vec3& size_m,
            const Transform& pose) {
    Item& item = scene_.items.emplace_back();
    item.name = name;
    item.robot = robot_;
    item.node = node;
    item.shape = shape;
    item.size_m = size_m;
    item.pose = pose;
    item.round_m = rounding_m(shape, size_m);
    item.material = default_material(e_, node, extent(shape, size_m));
    return item;
  }

  void add_visual(int node, const model::Visual& visual) {
    Item& item = add(node, visual.name, shape_of(visual.shape), visual.size_m, visual.pose);
    item.mesh_file = visual.mesh;
    if (visual.rgba) {
      const auto& [r, g, b, a] = *visual.rgba;
      item.material = {.colour = {r, g, b, a}};
    }
    if (visual.emissive_rgb) {
      const auto& [r, g, b] = *visual.emissive_rgb;
      item.material.glow = {r, g, b, 1};
    }
    item.material.texture = visual.texture;
  }

  void add_collision(int node, const model::Collision& shape, bool as_visual) {
    Item& item = add(node, e_.nodes[static_cast<std::size_t>(node)].name, shape_of(shape.shape),
                     shape.size_m, shape.pose);
    item.collision = !as_visual;
    if (as_visual) return;
    item.material = {.colour = {0.2F, 0.75F, 0.45F, 0.35F}};
    item.round_m = 0;
  }

  void add_link(int index) {
    const model::Node& node = e_.nodes[static_cast<std::size_t>(index)];
    bool drawn = false;
    for (const model::Visual& visual : node.visuals) {
      if (!can_be_drawn(visual)) continue;
      add_visual(index, visual);
      drawn = true;
    }
    for (const model::Collision& shape : node.collisions) add_collision(index, shape, false);
    if (drawn) return;
    for (const model::Collision& shape : node.collisions) add_collision(index, shape, true);
    if (node.collisions.empty()) add_body_of_inertia(index);
  }

  /// A uniform box with a shapeless link's mass and inertia.
  void add_body_of_inertia(int index) {
    const model::Node& node = e_.nodes[static_cast<std::size_t>(index)];
    if (node.mass_kg <= 0) return;
    const Vec3 moment = node.inertia_kg_m2.diagonal();
    const Vec3 square = 6 / node.mass_kg * (Vec3::Constant(moment.sum()) - 2 * moment);
    const Vec3 edges_m = square.cwiseMax(1e-4).cwiseSqrt().cwiseMin(0.12);
    Transform pose = Transform::Identity();
    pose.translation() = node.com_m;
    add(index, node.name, Shape::kBox, edges_m, pose);
  }

  void add_camera(const model::CameraSensor& sensor) {
    scene_.cameras.push_back({sensor.name, robot_, sensor.node, sensor.pose,
                              sensor.horizontal_fov_rad(), sensor.width_px, sensor.height_px,
                              sensor.near_m, sensor.far_m});
    Transform rim = sensor.pose;
    rim.translate(Vec3(-0.004, 0, 0))
        .rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
    add(sensor.node, sensor.name + " rim", Shape::kCylinder, {0.017, 0, 0.012}, rim).material = {
        .colour = {0.13F, 0.14F, 0.16F, 1}, .roughness = 0.35F};
    Transform glass = sensor.pose;
    glass.translate(Vec3(-0.006, 0, 0));
    add(sensor.node, sensor.name + " glass", Shape::kSphere, {0.0125, 0, 0}, glass).material = {
        .colour = {0.03F, 0.05F, 0.09F, 1}, .roughness = 0.08F};
  }

  /// An axle between links without colour: otherwise their boxes hang in the air.
  void add_hub(const model::Joint& joint) {
    const int node = static_cast<int>(&joint - e_.joints.data()) + 1;
    double least_m = 1;
    for (const int link : {joint.parent, node}) {
      const std::vector<model::Visual>& visuals = e_.nodes[static_cast<std::size_t>(link)].visuals;
      if (visuals.empty()) return;
      for (const model::Visual& visual : visuals) {
        if (visual.shape != model::Visual::Shape::kBox || visual.rgba) return;
        least_m = std::min(least_m, visual.size_m.minCoeff());
      }
    }
    const double radius_m = std::clamp(0.42 * least_m, 0.006, 0.016);
    Transform pose(model::turn_of_z(joint.axis));
    add(node, joint.name + " axle", Shape::kCylinder, {radius_m, 0, 2.4 * radius_m}, pose)
        .material = {.colour = {0.17F, 0.18F, 0.20F, 1}, .roughness = 0.45F};
  }

  /// Standing, from what is drawn: many files have few shapes that collide, or none.
  Eigen::AlignedBox3d drawn_m() const {
    const RobotView view = standing(e_);
    Vec3 middle_m = view.link_world.front().translation();
    middle_m.z() = 0;
    Eigen::AlignedBox3d box(Vec3(0, 0, 0), Vec3(0, 0, 0.1));
    for (const Item& item : scene_.items) {
      if (item.robot != robot_ || item.collision) continue;
      const Eigen::AlignedBox3d own = box_of(item);
      const Transform pose = view.link_world[static_cast<std::size_t>(item.node)] * item.pose;
      const Vec3 half_m = pose.linear().cwiseAbs() * (own.sizes() / 2);
      const Vec3 centre_m = pose * own.center() - middle_m;
      box.extend(centre_m - half_m).extend(centre_m + half_m);
    }
    return box;
  }

  Scene& scene_;
  const Entity& e_;
  const Meshes meshes_;
  const int robot_;
};

}  // namespace

Scene studio() {
  Scene scene;
  Light key{
      .direction = Vec3(-0.62, 0.42, -1.0), .colour = {1, 0.97F, 0.92F, 1}, .strength = 1.05F};
  key.shadows = true;
  Light fill{
      .direction = Vec3(-0.5, -0.9, -0.55), .colour = {0.85F, 0.92F, 1, 1}, .strength = 0.24F};
  Light rim{.direction = Vec3(0.9, 0.25, -0.6), .colour = {0.95F, 0.97F, 1, 1}, .strength = 0.30F};
  scene.lights = {key, fill, rim};
  return scene;
}

int add_robot(Scene& scene, const Entity& entity, Meshes meshes) {
  return RobotBuilder(scene, entity, meshes).build();
}

void tint(Scene& scene, int robot, const Colour& colour) {
  constexpr float kShare = 0.55F;
  const auto mix = [](float& own, float other) { own += kShare * (other - own); };
  for (Item& item : scene.items) {
    if (item.robot != robot || item.collision) continue;
    mix(item.material.colour.r, colour.r);
    mix(item.material.colour.g, colour.g);
    mix(item.material.colour.b, colour.b);
  }
}

RobotView posed(const Entity& entity, const Transform& body_world,
                const std::vector<double>& joint_rad) {
  RobotView view;
  view.link_world = sim::link_poses(entity, body_world, joint_rad);
  view.joint_rad = joint_rad;
  return view;
}

RobotView standing(const Entity& entity, const Vec3& start_m, double yaw_rad) {
  std::vector<double> joint_rad;
  for (const model::Joint& joint : entity.joints) joint_rad.push_back(joint.stand_rad);
  return posed(entity, sim::standing_pose(entity, joint_rad, start_m, yaw_rad, 0), joint_rad);
}

}  // namespace verp::scene
