#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/model/params.hpp"

namespace verp::tune {

/// Search space: the tuned numbers, in steps that suit a robot of this size.
class Space {
 public:
  explicit Space(const Params& params);

  Eigen::Index size() const { return static_cast<Eigen::Index>(axes_.size()); }
  /// The point of this Tuning.
  Eigen::VectorXd at(const Tuning& tuning) const;
  /// The Tuning at a point, each number clamped to its range; steps may be as long as the speed
  /// needs.
  Tuning tuning(const Eigen::VectorXd& at, double speed_m_s) const;
  /// A grid of cycles and hip heights to try first; other numbers stay. The first one is `start`.
  std::vector<Tuning> first_look(double speed_m_s) const;

 private:
  struct Axis {
    int id;
    double step;
  };
  std::vector<Axis> axes_;
  Tuning start_;
};

}  // namespace verp::tune
