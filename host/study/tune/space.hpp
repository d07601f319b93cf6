#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/model/params.hpp"

namespace verp::tune {

/// Tuned numbers, in steps for a robot of this size.
class Space {
 public:
  explicit Space(const Params& params);

  Eigen::Index size() const { return static_cast<Eigen::Index>(axes_.size()); }
  Eigen::VectorXd at(const Tuning& tuning) const;
  /// Clamped to ranges; steps may be as long as the speed needs.
  Tuning tuning(const Eigen::VectorXd& at, double speed_m_s) const;
  /// Cycles and hip heights to try first, from `start`.
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
