#include <algorithm>

#include "host/show/scene/build.hpp"
#include "host/show/scene/looks.hpp"

namespace verp::scene {
namespace {

using Kind = model::Shape::Kind;

constexpr double kMostRound_m = 0.004;  // more would look unlike what physics touches

Colour colour_of(const model::Color& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]),
          static_cast<float>(c[3])};
}

Colour mixed(const Colour& a, const Colour& b, float part) {
  return {a.r + part * (b.r - a.r), a.g + part * (b.g - a.g), a.b + part * (b.b - a.b), 1};
}

Shape shape_of(Kind kind) {
  constexpr Shape kShapes[] = {Shape::kPlane,    Shape::kBox,     Shape::kSphere,
                               Shape::kCylinder, Shape::kCapsule, Shape::kTriangles,
                               Shape::kTriangles};
  return kShapes[static_cast<int>(kind)];
}

/// SDF gives only brightness: bright means smooth.
Material material_of(const model::Material& m) {
  const double shine = std::max({m.specular[0], m.specular[1], m.specular[2]});
  Material out;
  out.colour = colour_of(m.diffuse);
  out.colour.a *= static_cast<float>(1 - m.transparency);
  out.roughness = static_cast<float>(std::clamp(0.9 - 0.7 * shine, 0.1, 0.9));
  out.glow = colour_of(m.emissive);
  out.texture = m.texture;
  return out;
}

std::shared_ptr<const Triangles> triangles_of(const model::Mesh& mesh) {
  auto out = std::make_shared<Triangles>();
  for (const Vec3& point : mesh.vertex_m) out->points.push_back(point.cast<float>());
  for (const auto& corners : mesh.triangle)
    out->indices.insert(out->indices.end(), corners.begin(), corners.end());
  return out;
}

std::shared_ptr<const Triangles> triangles_of(const model::Heightfield& field) {
  auto out = std::make_shared<Triangles>();
  const double dx_m = field.size_x_m / (field.columns - 1),
               dy_m = field.size_y_m / (field.rows - 1);
  const auto slope = [](double before, double after, int cells, double cell_m) {
    return (after - before) / (std::max(cells, 1) * cell_m);
  };
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const int left = std::max(column - 1, 0), right = std::min(column + 1, field.columns - 1);
      const int low = std::max(row - 1, 0), high = std::min(row + 1, field.rows - 1);
      out->points.push_back(Vec3(column * dx_m - field.size_x_m / 2,
                                 row * dy_m - field.size_y_m / 2, field.at(column, row))
                                .cast<float>());
      out->normals.push_back(
          Vec3(-slope(field.at(left, row), field.at(right, row), right - left, dx_m),
               -slope(field.at(column, low), field.at(column, high), high - low, dy_m), 1)
              .normalized()
              .cast<float>());
      out->texture_at.emplace_back(
          static_cast<float>(column) / static_cast<float>(field.columns - 1),
          static_cast<float>(row) / static_cast<float>(field.rows - 1));
    }
  }
  for (int row = 0; row + 1 < field.rows; ++row) {
    for (int column = 0; column + 1 < field.columns; ++column) {
      const auto at = static_cast<std::uint32_t>(row * field.columns + column);
      const auto up = at + static_cast<std::uint32_t>(field.columns);
      for (const std::uint32_t corner : {at, at + 1, up, up, at + 1, up + 1})
        out->indices.push_back(corner);
    }
  }
  return out;
}

Light light_of(const model::Light& light, bool shadows) {
  Light out;
  out.kind = light.kind == model::Light::Kind::kPoint  ? Light::Kind::kPoint
             : light.kind == model::Light::Kind::kSpot ? Light::Kind::kSpot
                                                       : Light::Kind::kSun;
  out.position_m = light.pose.translation();
  out.direction = light.direction;
  out.colour = colour_of(light.diffuse);
  out.range_m = light.range_m;
  out.fading = Vec3(light.constant, light.linear_1_m, light.quadratic_1_m2);
  out.inner_rad = light.inner_rad / 2;  // SDF: full cone
  out.outer_rad = std::max(light.outer_rad / 2, out.inner_rad + 1e-3);
  out.shadows = light.casts_shadows && shadows;
  return out;
}

Fog fog_of(const model::Fog& fog) {
  Fog out{.on = true, .colour = colour_of(fog.color), .begin_m = fog.start_m, .end_m = fog.end_m};
  if (fog.kind == model::Fog::Kind::kLinear) return out;
  out.density_1_m = std::max(fog.density_1_m, 1e-9);
  out.squared = fog.kind == model::Fog::Kind::kSquared;
  return out;
}

class WorldBuilder {
 public:
  explicit WorldBuilder(const model::World& world) : world_(world) {}

  Scene build() {
    add_air();
    for (const model::Light& light : world_.lights)
      scene_.lights.push_back(light_of(light, world_.shadows));
    int moving = 0;
    for (const model::WorldObject& object : world_.objects) {
      const bool stands = object.kind == model::WorldObject::Kind::kStatic;
      body_ = stands ? kWorld : moving++;
      frame_ = stands ? object.pose : Transform::Identity();
      for (const model::WorldVisual& visual : object.visuals) add_visual(object, visual);
      for (const model::WorldCollision& each : object.collisions) {
        if (each.shape.kind == Kind::kPlane) continue;
        Item& item = add(object, each.shape, each.pose);
        item.material = {.colour = {0.2F, 0.75F, 0.45F, 0.35F}};
        item.collision = true;
      }
    }
    if (world_.view) {
      scene_.cameras.push_back(
          {.name = "world", .robot = kWorld, .pose = *world_.view, .far_m = 100});
    }
    return std::move(scene_);
  }

 private:
  void add_air() {
    scene_.ground.on = false;
    scene_.ambient = colour_of(world_.ambient);
    scene_.ambient_strength = 1;
    const Colour background = colour_of(world_.background);
    scene_.sky = {background, background};
    if (world_.sky) scene_.sky.horizon = mixed(background, {1, 1, 1, 1}, 0.6F);
    if (world_.fog) scene_.fog = fog_of(*world_.fog);
    scene_.antialias = world_.antialias;
    scene_.textures = world_.textures;
    scene_.transparency = world_.transparency;
  }

  Item& add(const model::WorldObject& object, const model::Shape& shape, const Transform& pose) {
    Item& item = scene_.items.emplace_back();
    item.name = object.name;
    item.node = body_;
    item.pose = frame_ * pose;
    item.shape = shape_of(shape.kind);
    item.size_m = shape.size_m;
    item.round_m = std::min(rounding_m(item.shape, item.size_m), kMostRound_m);
    if (shape.mesh && !shape.mesh->triangle.empty()) {
      item.triangles = triangles_of(*shape.mesh);
    } else if (shape.mesh) {  // any format, by the renderer
      item.shape = Shape::kMesh;
      item.mesh_file = shape.mesh->file;
    }
    if (shape.heightfield) item.triangles = triangles_of(*shape.heightfield);
    return item;
  }

  void add_visual(const model::WorldObject& object, const model::WorldVisual& visual) {
    if (is_floor(visual)) return add_floor(visual);
    add(object, visual.shape, visual.pose).material = material_of(visual.material);
  }

  /// At height 0 it has no end, as in physics.
  bool is_floor(const model::WorldVisual& visual) const {
    const Transform pose = frame_ * visual.pose;
    return visual.shape.kind == Kind::kPlane && visual.material.texture.empty() &&
           pose.linear()(2, 2) > 1 - 1e-9 && std::abs(pose.translation().z()) < 1e-6;
  }

  void add_floor(const model::WorldVisual& visual) {
    constexpr Colour kDark{0, 0, 0, 1};
    scene_.ground.on = true;
    scene_.ground.light = colour_of(visual.material.diffuse);
    scene_.ground.dark = mixed(scene_.ground.light, kDark, 0.035F);
    scene_.ground.line = mixed(scene_.ground.light, kDark, 0.14F);
    scene_.ground.tile_m = 0.25;
    scene_.ground.fade_m = 14;
  }

  const model::World& world_;
  Scene scene_;
  Transform frame_ = Transform::Identity();
  int body_ = kWorld;
};

}  // namespace

Scene surroundings(const model::World* world) {
  return world == nullptr ? studio() : WorldBuilder(*world).build();
}

}  // namespace verp::scene
