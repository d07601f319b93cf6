#include "host/author/import/masses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace verp::import {
namespace {

// Shares of the robot's size: a link's radius of gyration.
constexpr double kMostGyration = 0.3, kUsualGyration = 0.05;
constexpr double kLinkShare = 0.01;  // of the robot's mass: a link whose mass the file lacks

double ball_of(double gyration_m) {
  return gyration_m / std::sqrt(0.4);
}

class Mender {
 public:
  Mender(const Skeleton& skeleton, const std::vector<int>& moving, Wrapper& wrapper)
      : s_(skeleton), moving_(moving), w_(wrapper) {
    Eigen::AlignedBox3d extent;
    for (const LinkPart& part : s_.links) extent.extend(part.pose.translation());
    size_m_ = extent.sizes().norm();
  }

  std::vector<std::string> mend() {
    const double unit = unit_of_inertias();
    for (const LinkPart& part : s_.links) mend_moments(part, part.radius_m * std::sqrt(unit));
    for (const int each : moving_) weigh(s_.bones[static_cast<std::size_t>(each)].child);
    return std::move(said_);
  }

 private:
  /// In kg m2: 1, unless most links would be larger than the robot.
  double unit_of_inertias() {
    std::vector<double> radii;
    for (const LinkPart& part : s_.links) {
      if (part.radius_m > 0) radii.push_back(part.radius_m);
    }
    if (radii.empty()) return 1;
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    if (*middle < size_m_) return 1;
    for (const auto& [unit, factor] :
         {std::pair{"g m2", 1e-3}, {"kg mm2", 1e-6}, {"g cm2", 1e-7}, {"g mm2", 1e-9}}) {
      if (*middle * std::sqrt(factor) > kMostGyration * size_m_) continue;
      w_.inertia_scales.emplace_back("*", factor);
      said_.push_back(fmt::format("all moments of inertia are taken as {}", unit));
      return factor;
    }
    return 1;
  }

  void mend_moments(const LinkPart& part, double radius_m) {
    const bool is_small = radius_m < size_m_;
    const double usual_m = kUsualGyration * size_m_;
    if (part.is_no_body) {
      const double gyration_m = is_small && radius_m > 0 ? radius_m : usual_m;
      w_.balls.push_back({part.name, std::clamp(ball_of(gyration_m), 0.001, 1.0), 0});
      said_.push_back(fmt::format(
          "link {}: no body has its moments of inertia; those of a ball are taken", part.name));
    } else if (!is_small) {
      w_.inertia_scales.emplace_back(part.name, std::pow(usual_m / radius_m, 2));
      said_.push_back(
          fmt::format("link {}: its moments are those of a body of {:.2g} m; "
                      "those of {:.2g} m are taken",
                      part.name, radius_m, usual_m));
    }
  }

  /// A joint must move some mass.
  void weigh(int moved) {
    double mass_kg = 0;
    std::vector<int> piece = {moved};
    for (std::size_t i = 0; i < piece.size(); ++i) {
      mass_kg += s_.links[static_cast<std::size_t>(piece[i])].mass_kg;
      for (std::size_t b = 0; b < s_.bones.size(); ++b) {
        if (s_.bones[b].parent == piece[i] && !moves(static_cast<int>(b)))
          piece.push_back(s_.bones[b].child);
      }
    }
    if (mass_kg > 0) return;
    const std::string& name = s_.links[static_cast<std::size_t>(moved)].name;
    const double guess_kg = kLinkShare * s_.mass_kg();
    w_.balls.push_back({name, ball_of(kUsualGyration * size_m_), guess_kg});
    said_.push_back(
        fmt::format("link {} has no mass: {:.2g} kg are taken, a guess", name, guess_kg));
  }

  bool moves(int bone) const {
    return std::find(moving_.begin(), moving_.end(), bone) != moving_.end();
  }

  const Skeleton& s_;
  const std::vector<int>& moving_;
  Wrapper& w_;
  double size_m_ = 0;
  std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> mend_masses(const Skeleton& skeleton, const std::vector<int>& moving,
                                     Wrapper& wrapper) {
  return Mender(skeleton, moving, wrapper).mend();
}

}  // namespace verp::import
