#pragma once
#include <cstdint>
#include <vector>

#include "host/apps/demos/brain/scan.hpp"

namespace verp::brain {

/// Occupancy grid of a floor from laser scans: cells are occupied, free or unseen. The frame's
/// origin is in the middle.
class Grid {
 public:
  static constexpr double kCell_m = 0.05;
  static constexpr int kCells = 240;  ///< per side: 12 m

  Grid() : odds_(static_cast<std::size_t>(kCells) * kCells, 0) {}

  static int cell(double at_m) { return static_cast<int>(std::floor(at_m / kCell_m)) + kCells / 2; }
  static double middle_m(int cell) { return (cell - kCells / 2 + 0.5) * kCell_m; }
  static bool inside(int x, int y) { return x >= 0 && y >= 0 && x < kCells && y < kCells; }
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x);
  }

  /// Adds the rays of a scan that the robot took at that pose.
  void add(const Pose& robot, const About& about, const std::vector<Hit>& hits);
  /// Certainly occupied.
  bool taken(int x, int y) const { return inside(x, y) && odds_[index(x, y)] >= kTaken; }
  /// How well the hits match the grid if the robot stands there: mean over all hits, 0 to 1.
  double fit(const Pose& robot, const std::vector<Hit>& hits) const;
  /// Each cell's distance to the nearest occupied cell, m; at most `most_m`.
  std::vector<float> clearance_m(double most_m) const;
  bool empty() const { return adds_ == 0; }

 private:
  static constexpr int kHit = 3, kMiss = 1, kMost = 30, kTaken = 6;
  void count(int x, int y, int by);
  double at(double x_m, double y_m) const;

  std::vector<std::int8_t> odds_;
  int adds_ = 0;
};

/// Scan matching: the pose near `about_there` that fits the hits best, or `about_there` if none
/// fits.
Pose matched(const Grid& grid, const Pose& about_there, const std::vector<Hit>& hits);

/// Cheapest path between two points that keeps clear of occupied cells (A*). Unseen cells count as
/// free. Empty: there is no path.
std::vector<Point> way(const Grid& grid, Point from, Point to);

}  // namespace verp::brain
