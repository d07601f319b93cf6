#include "host/apps/demos/outlines.hpp"

#include <cmath>
#include <numbers>

namespace verp::demos {
namespace {

constexpr double kLow_m = 0.03;
constexpr int kCorners = 16;  // of a round shape

using Kind = model::Shape::Kind;

double top_m(const model::Shape& shape) {
  if (shape.kind == Kind::kBox || shape.kind == Kind::kCylinder) return shape.size_m.z() / 2;
  return shape.kind == Kind::kSphere || shape.kind == Kind::kCapsule ? shape.size_m.x() : 0;
}

Outline outline_of(const model::Shape& shape, const model::Transform& pose) {
  Outline out;
  const auto add = [&](double x_m, double y_m) {
    const model::Vec3 at = pose * model::Vec3(x_m, y_m, 0);
    out.corners.push_back({at.x(), at.y()});
  };
  if (shape.kind == Kind::kBox) {
    const double x_m = shape.size_m.x() / 2, y_m = shape.size_m.y() / 2;
    add(x_m, y_m);
    add(-x_m, y_m);
    add(-x_m, -y_m);
    add(x_m, -y_m);
    return out;
  }
  for (int i = 0; i < kCorners; ++i) {
    const double at_rad = 2 * std::numbers::pi * i / kCorners;
    add(shape.size_m.x() * std::cos(at_rad), shape.size_m.x() * std::sin(at_rad));
  }
  return out;
}

}  // namespace

std::vector<Outline> outlines_of(const model::World& world) {
  std::vector<Outline> out;
  for (const model::WorldObject& object : world.objects) {
    if (object.kind != model::WorldObject::Kind::kStatic) continue;
    for (const model::WorldCollision& each : object.collisions) {
      const model::Transform pose = object.pose * each.pose;
      const double half_m = top_m(each.shape);
      if (half_m == 0 || pose.translation().z() + half_m < kLow_m) continue;
      out.push_back(outline_of(each.shape, pose));
    }
  }
  return out;
}

}  // namespace verp::demos
