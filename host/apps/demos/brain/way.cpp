#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "host/apps/demos/brain/grid.hpp"

namespace verp::brain {
namespace {

constexpr double kBody_m = 0.2;    // half a robot's width with arms, plus sway
constexpr double kShy_m = 0.45;    // nearer to a wall, a path costs more
constexpr double kShyCost = 3;     // this many times as much at kBody_m
constexpr double kStart_m = 0.25;  // so near its start, a robot may pass narrow cells

struct Open {
  double cost = 0;
  int x = 0, y = 0;
  bool operator<(const Open& other) const { return cost > other.cost; }  // the cheapest on top
};

}  // namespace

std::vector<Point> way(const Grid& grid, Point from, Point to) {
  const std::vector<float> clear_m = grid.clearance_m(kShy_m);
  const int from_x = Grid::cell(from.x), from_y = Grid::cell(from.y);
  const int to_x = Grid::cell(to.x), to_y = Grid::cell(to.y);
  if (!Grid::inside(from_x, from_y) || !Grid::inside(to_x, to_y)) return {};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> cost(clear_m.size(), kNone);
  std::vector<std::size_t> before(clear_m.size(), clear_m.size());
  const auto left = [&](int x, int y) { return std::hypot(to_x - x, to_y - y); };
  std::priority_queue<Open> open;
  cost[Grid::index(from_x, from_y)] = 0;
  open.push({left(from_x, from_y), from_x, from_y});
  while (!open.empty()) {
    const Open at = open.top();
    open.pop();
    const std::size_t here = Grid::index(at.x, at.y);
    if (at.cost > cost[here] + left(at.x, at.y) + 1e-9) continue;  // a cheaper path was found
    if (at.x == to_x && at.y == to_y) break;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const int x = at.x + dx, y = at.y + dy;
        if ((dx == 0 && dy == 0) || !Grid::inside(x, y)) continue;
        const std::size_t there = Grid::index(x, y);
        const bool starts = Grid::kCell_m * std::hypot(x - from_x, y - from_y) < kStart_m;
        if (clear_m[there] < kBody_m && !(starts && clear_m[there] > 0)) continue;
        const double near = std::clamp((kShy_m - clear_m[there]) / (kShy_m - kBody_m), 0.0, 1.0);
        const double next = cost[here] + std::hypot(dx, dy) * (1 + kShyCost * near);
        if (next >= cost[there]) continue;
        cost[there] = next;
        before[there] = here;
        open.push({next + left(x, y), x, y});
      }
    }
  }
  std::size_t at = Grid::index(to_x, to_y);
  if (cost[at] == kNone) return {};
  std::vector<Point> out = {to};
  while (before[at] < before.size()) {
    at = before[at];
    const int x = static_cast<int>(at % Grid::kCells), y = static_cast<int>(at / Grid::kCells);
    out.push_back({Grid::middle_m(x), Grid::middle_m(y)});
  }
  std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace verp::brain
