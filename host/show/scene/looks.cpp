#include "host/show/scene/looks.hpp"

#include <algorithm>

namespace verp::scene {
namespace {

const Material kShell{.colour = {0.93F, 0.93F, 0.92F, 1}, .roughness = 0.42F};
const Material kServo{.colour = {0.17F, 0.18F, 0.20F, 1}, .roughness = 0.5F};
const Material kSole{.colour = {0.20F, 0.21F, 0.23F, 1}, .roughness = 0.7F};
const Material kAccent{.colour = {0.95F, 0.45F, 0.10F, 1}, .roughness = 0.4F};

bool ends_limb(const Entity& entity, int node, const char* kind) {
  return std::any_of(entity.limbs.begin(), entity.limbs.end(), [&](const model::Limb& limb) {
    return limb.name.ends_with(kind) && !limb.joints.empty() && limb.joints.back() + 1 == node;
  });
}

/// Compact, and no larger than a servo with its bracket.
bool is_servo(const Vec3& extent_m) {
  return extent_m.maxCoeff() < 1.7 * extent_m.minCoeff() && extent_m.maxCoeff() < 0.055;
}

}  // namespace

Material default_material(const Entity& entity, int node, const Vec3& extent_m) {
  if (ends_limb(entity, node, "leg")) return kSole;
  if (ends_limb(entity, node, "arm")) return kAccent;
  return is_servo(extent_m) ? kServo : kShell;
}

double rounding_m(Shape shape, const Vec3& size_m) {
  constexpr double kMost_m = 0.014;
  if (shape == Shape::kBox) return std::min(0.22 * size_m.minCoeff(), kMost_m);
  if (shape == Shape::kCylinder) return std::min(0.25 * std::min(size_m.x(), size_m.z()), 0.004);
  return 0;
}

}  // namespace verp::scene
