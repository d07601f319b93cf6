#include "host/show/render/stage.hpp"

#include <algorithm>

#include "host/show/render/files.hpp"
#include "host/show/render/shapes.hpp"

namespace verp::render {
namespace {

scene::Triangles triangles_of(const scene::Item& item, double round_m) {
  using scene::Shape;
  const scene::Vec3& size_m = item.size_m;
  switch (item.shape) {
    case Shape::kBox:
      return box(size_m, round_m);
    case Shape::kSphere:
      return sphere(size_m.x());
    case Shape::kCapsule:
      return capsule(size_m.x(), size_m.z());
    case Shape::kCylinder:
      return cylinder(size_m.x(), size_m.z(), round_m);
    case Shape::kPlane:
      return plane(size_m.x(), size_m.y());
    default:
      return item.triangles ? *item.triangles : scene::Triangles();
  }
}

}  // namespace

void Stage::fill(const scene::Scene& scene) {
  scene_ = scene;
  notes_ = scene.notes;
  files_.clear();
  pictures_.clear();
  const std::size_t count = scene_.items.size();
  own_ = std::vector<GpuMesh>(count);
  sharp_ = std::vector<GpuMesh>(count);
  mesh_.assign(count, nullptr);
  texture_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) upload(scene_.items[i], i);
}

void Stage::upload(const scene::Item& item, std::size_t index) {
  if (item.shape == scene::Shape::kMesh) {
    mesh_[index] = &mesh_of_file(item.mesh_file);
  } else {
    scene::Triangles mesh = triangles_of(item, item.round_m);
    if (mesh.normals.size() != mesh.points.size()) add_flat_normals(mesh);
    own_[index] = GpuMesh(mesh);
    mesh_[index] = &own_[index];
    const bool rounded = item.shape == scene::Shape::kBox && item.round_m > 0;
    if (rounded) sharp_[index] = GpuMesh(triangles_of(item, 0));
  }
  if (!item.material.texture.empty()) texture_[index] = texture_of_file(item.material.texture);
}

const GpuMesh& Stage::mesh_of_file(const std::string& file) {
  const auto [found, fresh] = files_.try_emplace(file);
  if (!fresh) return found->second;
  try {
    found->second = GpuMesh(read_mesh(file));
  } catch (const RenderError& error) {
    notes_.push_back(std::string(error.what()) + "; it is not drawn");
  }
  return found->second;
}

GLuint Stage::texture_of_file(const std::string& file) {
  const auto [found, fresh] = pictures_.try_emplace(file);
  if (!fresh) return found->second.id();
  try {
    found->second = read_texture(file);
  } catch (const RenderError& error) {
    notes_.push_back(std::string(error.what()) + "; it is not drawn");
  }
  return found->second.id();
}

void Stage::set_looks(const scene::Scene& scene) {
  scene_.lights = scene.lights;
  scene_.ambient = scene.ambient;
  scene_.ambient_strength = scene.ambient_strength;
  scene_.fog = scene.fog;
  scene_.sky = scene.sky;
  scene_.ground = scene.ground;
  scene_.antialias = scene.antialias;
  scene_.textures = scene.textures;
  scene_.transparency = scene.transparency;
  for (std::size_t i = 0; i < std::min(scene.items.size(), scene_.items.size()); ++i) {
    const std::string texture = scene_.items[i].material.texture;
    scene_.items[i].material = scene.items[i].material;
    scene_.items[i].material.texture = texture;
  }
}

std::vector<Placed> Stage::place(const scene::Snapshot& now, const Effects& effects) const {
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < scene_.items.size(); ++i) {
    const scene::Item& item = scene_.items[i];
    if (mesh_[i]->empty() || !(item.collision ? effects.collisions : effects.visuals)) continue;
    scene::Transform frame = scene::Transform::Identity();
    const auto node = static_cast<std::size_t>(item.node);
    if (item.robot != scene::kWorld) {
      const auto robot = static_cast<std::size_t>(item.robot);
      if (robot >= now.robots.size() || node >= now.robots[robot].link_world.size()) continue;
      frame = now.robots[robot].link_world[node];
    } else if (item.node != scene::kWorld) {
      if (node >= now.body_world.size()) continue;
      frame = now.body_world[node];
    }
    const Mat4 world = (frame * item.pose).matrix().cast<float>();
    if (!world.allFinite()) continue;
    const bool scaled = item.shape == scene::Shape::kMesh;
    placed.push_back(
        {&item, mesh_[i], sharp_[i].empty() ? nullptr : &sharp_[i], texture_[i],
         static_cast<int>(i), world,
         scaled ? Eigen::Vector3f(item.size_m.cast<float>()) : Eigen::Vector3f(1, 1, 1)});
  }
  return placed;
}

Stage::Ball Stage::extent(const scene::Snapshot& now, const scene::Camera& camera) const {
  constexpr double kMost_m = 4;
  Eigen::AlignedBox3d around;
  double margin_m = 0.1;
  for (std::size_t r = 0; r < std::min(now.robots.size(), scene_.robots.size()); ++r) {
    margin_m = std::max(margin_m, 0.22 * scene_.robots[r].height_m);
    for (const scene::Transform& link : now.robots[r].link_world) {
      if (link.translation().allFinite()) around.extend(link.translation());
    }
  }
  for (const scene::Item& item : scene_.items) {
    if (item.robot == scene::kWorld && !item.collision && item.shape != scene::Shape::kPlane) {
      const scene::Vec3 half_m = scene::Vec3::Constant(item.size_m.cwiseAbs().maxCoeff() / 2);
      around.extend(item.pose.translation() - half_m);
      around.extend(item.pose.translation() + half_m);
    }
  }
  if (around.isEmpty()) return {camera.target_m, 1};
  const double radius_m = around.diagonal().norm() / 2 + margin_m;
  if (radius_m <= kMost_m) return {around.center(), radius_m};
  return {camera.target_m, kMost_m};
}

}  // namespace verp::render
