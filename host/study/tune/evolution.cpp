#include "host/study/tune/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace verp::tune {

Evolution::Evolution(const Eigen::VectorXd& start, double step, int children, std::uint64_t seed)
    : mean_(start),
      spread_(Eigen::VectorXd::Ones(start.size())),
      path_(Eigen::VectorXd::Zero(start.size())),
      step_path_(Eigen::VectorXd::Zero(start.size())),
      weights_(children / 2),
      step_(step),
      points_(static_cast<std::size_t>(children)),
      random_(seed) {
  for (Eigen::Index i = 0; i < weights_.size(); ++i)
    weights_[i] = std::log(0.5 * (children + 1)) - std::log(static_cast<double>(i + 1));
  weights_ /= weights_.sum();
  effective_ = 1 / weights_.squaredNorm();
}

const std::vector<Eigen::VectorXd>& Evolution::ask() {
  std::normal_distribution<double> normal;
  for (Eigen::VectorXd& point : points_) {
    point.resize(mean_.size());
    for (Eigen::Index i = 0; i < point.size(); ++i)
      point[i] = mean_[i] + step_ * std::sqrt(spread_[i]) * normal(random_);
  }
  return points_;
}

// The paper's names: c_s, d_s for the step; c_c, c_1, c_mu for the spread, times (n + 2) / 3, which
// a diagonal spread allows.
void Evolution::tell(const std::vector<double>& costs) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  const auto n = static_cast<double>(mean_.size());
  const double c_s = (effective_ + 2) / (n + effective_ + 5);
  const double d_s = 1 + 2 * std::max(0.0, std::sqrt((effective_ - 1) / (n + 1)) - 1) + c_s;
  const double c_c = (4 + effective_ / n) / (n + 4 + 2 * effective_ / n);
  const double times = (n + 2) / 3;
  const double c_1 = std::min(1.0, times * 2 / ((n + 1.3) * (n + 1.3) + effective_));
  const double c_mu = std::min(
      1 - c_1, times * 2 * (effective_ - 2 + 1 / effective_) / ((n + 2) * (n + 2) + effective_));
  const double usual_length = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));

  Eigen::VectorXd by = Eigen::VectorXd::Zero(mean_.size()), squares = by;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    const Eigen::VectorXd each = (points_[order[static_cast<std::size_t>(i)]] - mean_) / step_;
    by += weights_[i] * each;
    squares += weights_[i] * each.cwiseAbs2();
  }
  mean_ += step_ * by;
  ++generations_;
  step_path_ = (1 - c_s) * step_path_ +
               std::sqrt(c_s * (2 - c_s) * effective_) * by.cwiseQuotient(spread_.cwiseSqrt());
  const double grown = std::sqrt(1 - std::pow(1 - c_s, 2 * generations_));
  const bool on = step_path_.norm() / grown < (1.4 + 2 / (n + 1)) * usual_length;
  path_ = (1 - c_c) * path_;
  if (on) path_ += std::sqrt(c_c * (2 - c_c) * effective_) * by;
  const double lost = on ? 0 : c_1 * c_c * (2 - c_c);
  spread_ = (1 - c_1 - c_mu + lost) * spread_ + c_1 * path_.cwiseAbs2() + c_mu * squares;
  step_ *= std::exp(c_s / d_s * (step_path_.norm() / usual_length - 1));
}

}  // namespace verp::tune
