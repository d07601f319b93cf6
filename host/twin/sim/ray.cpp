#include <algorithm>
#include <limits>

#include "host/twin/sim/world.hpp"

namespace verp::sim {
namespace {

struct Nearest {
  const RayFilter* filter;
  double distance_m = std::numeric_limits<double>::infinity();
};

void meet_ray(void* data, dGeomID a, dGeomID b) {
  constexpr int kMost = 8;
  Nearest& nearest = *static_cast<Nearest*>(data);
  const dGeomID ray = dGeomGetClass(a) == dRayClass ? a : b;
  const dGeomID other = ray == a ? b : a;
  const auto* tag = static_cast<const GeomTag*>(dGeomGetData(other));
  if (tag == nullptr || (tag->owner == nearest.filter->owner && tag->node == nearest.filter->node))
    return;
  dContactGeom hits[kMost];
  const int count = dCollide(ray, other, kMost, hits, sizeof(dContactGeom));
  for (int i = 0; i < count; ++i)
    nearest.distance_m = std::min(nearest.distance_m, static_cast<double>(hits[i].depth));
}

}  // namespace

std::optional<double> World::ray_m(const Vec3& from_world_m, const Vec3& direction_world,
                                   double range_m, const RayFilter& filter) const {
  const Vec3 along = direction_world.normalized();
  const dGeomID ray = dCreateRay(nullptr, range_m);
  dGeomRaySet(ray, from_world_m.x(), from_world_m.y(), from_world_m.z(), along.x(), along.y(),
              along.z());
  dGeomRaySetClosestHit(ray, 1);
  Nearest nearest{&filter};
  dSpaceCollide2(ray, reinterpret_cast<dGeomID>(space_), &nearest, meet_ray);
  dGeomDestroy(ray);
  if (nearest.distance_m > range_m) return std::nullopt;
  return nearest.distance_m;
}

double World::height_m(double x_m, double y_m, double around_m) const {
  constexpr double kCeiling_m = 1.5, kDeep_m = 20;
  constexpr int kRays = 3;  // to each side
  double highest_m = -std::numeric_limits<double>::infinity();
  for (int i = -kRays; i <= kRays; ++i) {
    for (int j = -kRays; j <= kRays; ++j) {
      const Vec3 from(x_m + around_m * i / kRays, y_m + around_m * j / kRays, kCeiling_m);
      const auto hit_m = ray_m(from, -Vec3::UnitZ(), kDeep_m);
      if (hit_m) highest_m = std::max(highest_m, kCeiling_m - *hit_m);
    }
  }
  return highest_m > -kDeep_m ? highest_m : 0;
}

}  // namespace verp::sim
