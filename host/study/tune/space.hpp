#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/model/params.hpp"

namespace verp::tune {

/// The numbers that are looked for, each in steps that are sensible for a robot of this size.
class Space {
 public:
  explicit Space(const Params& params);

  Eigen::Index size() const { return static_cast<Eigen::Index>(axes_.size()); }
  /// Where this Tuning is.
  Eigen::VectorXd at(const Tuning& tuning) const;
  /// The Tuning there, within what each number may be; steps are let be as long as the speed needs.
  Tuning tuning(const Eigen::VectorXd& at, double speed_m_s) const;
  /// Cycles and hip heights to look at first, other numbers as they are. The first one is `start`.
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
