#include "host/apps/demos/brain/scan.hpp"

#include <cmath>
#include <limits>

namespace verp::brain {
namespace {

constexpr double kFloorShare = 0.8;  // share of a ray's way to the floor within which a hit counts
constexpr double kApart_m = 0.18;    // between two things; arms hang nearer to a trunk
constexpr double kWidest_m = 0.5;    // of a robot with its arms

/// Distance to the floor along a ray; inf if the ray does not descend.
double floor_m(const Scan& scan, double angle_rad) {
  const double down = scan.pitch_rad * std::cos(angle_rad) - scan.roll_rad * std::sin(angle_rad);
  return down > 1e-6 ? scan.high_m / down : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Hit> hits(const About& about, const Scan& scan) {
  std::vector<Hit> out;
  for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
    const double range_m = scan.range_m[i];
    if (!(range_m > 0) || range_m >= about.laser_max_m) continue;
    const double angle_rad = about.laser_first_rad + static_cast<double>(i) * about.laser_step_rad;
    if (range_m > kFloorShare * floor_m(scan, angle_rad)) continue;
    out.push_back({about.laser_m + turned({range_m, 0}, angle_rad), i, range_m});
  }
  return out;
}

std::vector<Thing> things(const About& about, const Scan& scan) {
  const std::vector<Hit> all = hits(about, scan);
  std::vector<Thing> out;
  for (std::size_t first = 0; first < all.size();) {
    std::size_t last = first;
    while (last + 1 < all.size() && distance(all[last].at_m, all[last + 1].at_m) < kApart_m) ++last;
    const double wide_m = distance(all[first].at_m, all[last].at_m);
    Point sum;
    for (std::size_t i = first; i <= last; ++i) sum = sum + all[i].at_m;
    if (wide_m < kWidest_m)
      out.push_back({1.0 / static_cast<double>(last - first + 1) * sum, wide_m});
    first = last + 1;
  }
  return out;
}

Point middle_of(const About& about, const Thing& thing) {
  const Point ray = thing.at_m - about.laser_m;
  return thing.at_m + kBehindSurface_m / std::fmax(length(ray), 0.01) * ray;
}

}  // namespace verp::brain
