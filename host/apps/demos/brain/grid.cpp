#include "host/apps/demos/brain/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace verp::brain {

void Grid::count(int x, int y, int by) {
  if (!inside(x, y)) return;
  std::int8_t& odds = odds_[index(x, y)];
  odds = static_cast<std::int8_t>(std::clamp(odds + by, -kMost, kMost));
}

void Grid::add(const Pose& robot, const About& about, const std::vector<Hit>& hits) {
  const Point laser = out_of(robot, about.laser_m);
  for (const Hit& hit : hits) {
    const Point end = out_of(robot, hit.at_m);
    const Point way = end - laser;
    const int steps = static_cast<int>(length(way) / (0.5 * kCell_m));
    int last_x = -1, last_y = -1;
    const int end_x = cell(end.x), end_y = cell(end.y);
    for (int i = 0; i < steps; ++i) {
      const Point at = laser + static_cast<double>(i) / steps * way;
      const int x = cell(at.x), y = cell(at.y);
      // Counts each cell once per ray. The end cell and its neighbours are not passed through.
      if ((x == last_x && y == last_y) || std::max(std::abs(x - end_x), std::abs(y - end_y)) < 2)
        continue;
      count(last_x = x, last_y = y, -kMiss);
    }
    count(end_x, end_y, kHit);
  }
  ++adds_;
}

/// Bilinear between four cell centres; only occupied cells count.
double Grid::at(double x_m, double y_m) const {
  const double x = x_m / kCell_m - 0.5, y = y_m / kCell_m - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  const auto value = [&](int dx, int dy) {
    const int cx = x0 + dx + kCells / 2, cy = y0 + dy + kCells / 2;
    return inside(cx, cy) ? std::max<int>(0, odds_[index(cx, cy)]) / static_cast<double>(kMost) : 0;
  };
  return (1 - fx) * (1 - fy) * value(0, 0) + fx * (1 - fy) * value(1, 0) +
         (1 - fx) * fy * value(0, 1) + fx * fy * value(1, 1);
}

double Grid::fit(const Pose& robot, const std::vector<Hit>& hits) const {
  if (hits.empty()) return 0;
  double sum = 0;
  const double c = std::cos(robot.yaw_rad), s = std::sin(robot.yaw_rad);
  for (const Hit& hit : hits) {
    sum += at(robot.at_m.x + c * hit.at_m.x - s * hit.at_m.y,
              robot.at_m.y + s * hit.at_m.x + c * hit.at_m.y);
  }
  return sum / static_cast<double>(hits.size());
}

std::vector<float> Grid::clearance_m(double most_m) const {
  constexpr float kSide = static_cast<float>(kCell_m), kAcross = 1.41421F * kSide;
  std::vector<float> far(odds_.size(), static_cast<float>(most_m));
  for (std::size_t i = 0; i < odds_.size(); ++i) {
    if (odds_[i] >= kTaken) far[i] = 0;
  }
  const auto relax = [&](int x, int y, int dx, int dy, float by) {
    if (inside(x + dx, y + dy))
      far[index(x, y)] = std::min(far[index(x, y)], far[index(x + dx, y + dy)] + by);
  };
  // Chamfer distance: two passes, one from each corner.
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      relax(x, y, -1, 0, kSide);
      relax(x, y, 0, -1, kSide);
      relax(x, y, -1, -1, kAcross);
      relax(x, y, 1, -1, kAcross);
    }
  }
  for (int y = kCells - 1; y >= 0; --y) {
    for (int x = kCells - 1; x >= 0; --x) {
      relax(x, y, 1, 0, kSide);
      relax(x, y, 0, 1, kSide);
      relax(x, y, 1, 1, kAcross);
      relax(x, y, -1, 1, kAcross);
    }
  }
  return far;
}

Pose matched(const Grid& grid, const Pose& about_there, const std::vector<Hit>& hits) {
  constexpr std::size_t kFewestRays = 20;  // fewer do not identify a place
  constexpr double kLeast = 0.15;
  if (hits.size() < kFewestRays) return about_there;
  Pose best = about_there;
  double best_fit = grid.fit(best, hits);
  // Searches around the best pose, finer each time. The nearer of equal fits wins.
  for (const double scale : {1.0, 0.5, 0.25}) {
    constexpr int kSteps = 2;
    const double step_m = 0.04 * scale, step_rad = 0.02 * scale;
    const Pose middle = best;
    for (int i = -kSteps; i <= kSteps; ++i) {
      for (int j = -kSteps; j <= kSteps; ++j) {
        for (int k = -kSteps; k <= kSteps; ++k) {
          const Pose there{middle.at_m + Point{i * step_m, j * step_m},
                           middle.yaw_rad + k * step_rad};
          constexpr double kShy_1_m = 0.2;
          const double fit =
              grid.fit(there, hits) - kShy_1_m * distance(there.at_m, about_there.at_m);
          if (fit > best_fit) {
            best_fit = fit;
            best = there;
          }
        }
      }
    }
  }
  best.yaw_rad = wrapped(best.yaw_rad);
  return best_fit < kLeast ? about_there : best;
}

}  // namespace verp::brain
