#pragma once
#include <cstdint>
#include <vector>

#include "host/apps/demos/brain/scan.hpp"

namespace verp::brain {

/// What a laser knows of a floor: cells that are taken, free, or not seen yet. The frame's origin
/// is in the middle.
class Grid {
 public:
  static constexpr double kCell_m = 0.05;
  static constexpr int kCells = 240;  ///< on each side: 12 m

  Grid() : odds_(static_cast<std::size_t>(kCells) * kCells, 0) {}

  static int cell(double at_m) { return static_cast<int>(std::floor(at_m / kCell_m)) + kCells / 2; }
  static double middle_m(int cell) { return (cell - kCells / 2 + 0.5) * kCell_m; }
  static bool inside(int x, int y) { return x >= 0 && y >= 0 && x < kCells && y < kCells; }
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * kCells + static_cast<std::size_t>(x);
  }

  /// Rays to what a robot saw from there.
  void add(const Pose& robot, const About& about, const std::vector<Hit>& hits);
  /// Surely taken.
  bool taken(int x, int y) const { return inside(x, y) && odds_[index(x, y)] >= kTaken; }
  /// How well what a robot sees fits if it stands there: the mean over all that it sees, 0 to 1.
  double fit(const Pose& robot, const std::vector<Hit>& hits) const;
  /// How far each cell is from the next one that is taken, m; at most `most_m`.
  std::vector<float> clearance_m(double most_m) const;
  bool empty() const { return adds_ == 0; }

 private:
  static constexpr int kHit = 3, kMiss = 1, kMost = 30, kTaken = 6;
  void count(int x, int y, int by);
  double at(double x_m, double y_m) const;

  std::vector<std::int8_t> odds_;
  int adds_ = 0;
};

/// Where a robot is that stands about there and sees that: the best of the places around, or
/// `about_there` if none fits.
Pose matched(const Grid& grid, const Pose& about_there, const std::vector<Hit>& hits);

/// The cheapest way between two points that keeps clear of what is taken: A* over the grid's cells;
/// what was not seen yet is taken for free. Empty: there is none.
std::vector<Point> way(const Grid& grid, Point from, Point to);

}  // namespace verp::brain
