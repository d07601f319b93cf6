#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace verp::tune {

/// Minimises a noisy, expensive cost: an evolution strategy with a step size per coordinate
/// (sep-CMA-ES, Ros and Hansen 2008). Pure: equal seeds and costs give equal points.
class Evolution {
 public:
  /// Coordinates are scaled so that `step` is a good first step in each.
  Evolution(const Eigen::VectorXd& start, double step, int children, std::uint64_t seed);

  const std::vector<Eigen::VectorXd>& ask();
  /// Costs of ask()'s points, in their order.
  void tell(const std::vector<double>& costs);
  const Eigen::VectorXd& mean() const { return mean_; }

 private:
  Eigen::VectorXd mean_, spread_, path_, step_path_;  ///< spread: variances
  Eigen::VectorXd weights_;                           ///< better half, best first
  double step_, effective_;
  std::vector<Eigen::VectorXd> points_;
  std::mt19937_64 random_;
  int generations_ = 0;
};

}  // namespace verp::tune
