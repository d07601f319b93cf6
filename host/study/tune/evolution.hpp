#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace verp::tune {

/// Looks for the point of least cost where each evaluation is dear and noisy: an evolution strategy
/// that adapts a step size for each coordinate (sep-CMA-ES, Ros and Hansen 2008). Pure: equal seeds
/// and costs, equal points.
class Evolution {
 public:
  /// From `start`; coordinates are scaled so that `step` is a good first step in each.
  Evolution(const Eigen::VectorXd& start, double step, int children, std::uint64_t seed);

  /// The next points to try.
  const std::vector<Eigen::VectorXd>& ask();
  /// Their costs, in that order.
  void tell(const std::vector<double>& costs);
  /// Where the best ones gather.
  const Eigen::VectorXd& mean() const { return mean_; }

 private:
  Eigen::VectorXd mean_, spread_, path_, step_path_;  ///< spread: of each coordinate, squared
  Eigen::VectorXd weights_;                           ///< of the better half, best first
  double step_, effective_;
  std::vector<Eigen::VectorXd> points_;
  std::mt19937_64 random_;
  int generations_ = 0;
};

}  // namespace verp::tune
