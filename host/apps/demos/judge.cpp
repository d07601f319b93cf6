#include "host/apps/demos/judge.hpp"

#include <algorithm>
#include <cmath>

namespace verp::demos {

std::vector<brain::Point> smooth(const Track& track) {
  constexpr double kHalf_s = 0.45;  // a gait cycle on each side
  std::vector<brain::Point> out;
  const auto& moments = track.moments;
  std::size_t first = 0, beyond = 0;
  for (const Moment& each : moments) {
    while (first < moments.size() && moments[first].time_s < each.time_s - kHalf_s) ++first;
    while (beyond < moments.size() && moments[beyond].time_s <= each.time_s + kHalf_s) ++beyond;
    brain::Point sum;
    for (std::size_t i = first; i < beyond; ++i) sum = sum + moments[i].real.at_m;
    out.push_back(1.0 / static_cast<double>(beyond - first) * sum);
  }
  return out;
}

Line::Line(std::vector<brain::Point> points) : points_(std::move(points)) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    along_m_.push_back(i == 0 ? 0 : along_m_.back() + distance(points_[i - 1], points_[i]));
}

brain::Pose Line::at(double along_m) const {
  if (points_.size() < 2) return {};
  const auto after = std::upper_bound(along_m_.begin(), along_m_.end(), along_m);
  const auto index = std::clamp<std::ptrdiff_t>(after - along_m_.begin(), 1,
                                                static_cast<std::ptrdiff_t>(points_.size()) - 1);
  const auto i = static_cast<std::size_t>(index);
  // Direction over a foot's length, because the remaining sway is no direction.
  constexpr double kAround_m = 0.1;
  std::size_t low = i - 1, high = i;
  while (low > 0 && along_m_[i] - along_m_[low] < kAround_m) --low;
  while (high + 1 < points_.size() && along_m_[high] - along_m_[i] < kAround_m) ++high;
  const double long_m = along_m_[i] - along_m_[i - 1];
  const double share = long_m > 0 ? (along_m - along_m_[i - 1]) / long_m : 0;
  const brain::Point way = points_[high] - points_[low];
  const double yaw_rad = length(way) > 0 ? direction_rad(way) : 0;
  if (share < 0 || share > 1) {  // straight on
    const brain::Point from = share < 0 ? points_.front() : points_.back();
    const double by_m = share < 0 ? along_m : along_m - along_m_.back();
    return {from + by_m * brain::turned({1, 0}, yaw_rad), yaw_rad};
  }
  return {points_[i - 1] + share * (points_[i] - points_[i - 1]), yaw_rad};
}

double Line::off_m(brain::Point point) const {
  double nearest_m = 1e9;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const brain::Point way = points_[i] - points_[i - 1];
    const brain::Point to = point - points_[i - 1];
    const double square = way.x * way.x + way.y * way.y;
    const double share =
        square > 0 ? std::clamp((to.x * way.x + to.y * way.y) / square, 0.0, 1.0) : 0;
    nearest_m = std::min(nearest_m, distance(point, points_[i - 1] + share * way));
  }
  return nearest_m;
}

Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  double square = 0;
  for (const double each : values) square += each * each;
  return {.rms = std::sqrt(square / static_cast<double>(values.size())),
          .worst = *std::max_element(values.begin(), values.end()),
          .least = *std::min_element(values.begin(), values.end())};
}

double drift_m(const Track& track) {
  if (track.moments.empty()) return 0;
  return distance(track.moments.back().real.at_m, track.moments.back().believed.at_m);
}

double way_m(const Track& track) {
  const std::vector<brain::Point> points = smooth(track);
  double sum_m = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum_m += distance(points[i - 1], points[i]);
  return sum_m;
}

}  // namespace verp::demos
