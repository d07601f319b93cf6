#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/study/identify/numbers.hpp"
#include "host/study/identify/rig.hpp"
#include "host/study/survey/workers.hpp"

namespace verp::identify {

/// What is looked for: numbers of one type's servos, and how much later they act than the bus says.
/// Values in the order of numbers(), the delay behind them, in us.
struct Estimate {
  std::vector<double> value, error;  ///< error: one standard deviation
  std::vector<bool> free;            ///< false: kept as it was
  double rms_rad = 0;                ///< what is left, over the ticks it was fitted to
};

/// Fits by simulation: the twin does what the robot was told, and its numbers are changed until its
/// joints are where the robot's were (Gauss-Newton with damping, errors beyond a few sigma counting
/// less).
class Fit {
 public:
  Fit(const model::Entity& entity, const Recording& recording, const std::string& type,
      const survey::Watch& watch);

  /// Over the first `ticks` of the recording, from where `estimate` stands.
  void improve(Estimate& estimate, std::size_t ticks, int rounds);
  /// Puts back what the motion does not tell, the least sure number first, until all others are.
  void leave_what_is_not_told(Estimate& estimate, std::size_t ticks);
  Estimate start() const;
  /// Where the joints are with these numbers, at the first `ticks`.
  std::vector<std::vector<float>> predict(const Estimate& estimate, std::size_t ticks);
  /// Of the type's joints, ticks from `from` on.
  double rms_rad(const std::vector<std::vector<float>>& predicted, std::size_t from,
                 std::size_t to) const;
  const std::vector<std::size_t>& joints() const { return joints_; }
  bool stopped() const { return stopped_; }
  /// So many ticks will be looked at, all rounds together: for who waits.
  void expect(std::size_t ticks) { expected_ = ticks; }

 private:
  struct Normal;
  std::size_t delay() const { return numbers().size(); }
  model::Entity with(const std::vector<double>& value) const;
  Simulated run(const std::vector<double>& value, int delay_steps, std::size_t ticks,
                std::uint64_t seed = 1) const;
  void see_chance(const Simulated& one, const Simulated& other, std::size_t ticks);
  Normal linearise(const Estimate& estimate, std::size_t ticks);
  Estimate moved(const Estimate& from, const Eigen::VectorXd& by) const;
  Estimate go_on(const Estimate& from, const Eigen::VectorXd& by, Estimate best, double cost_best,
                 std::size_t ticks);
  Eigen::VectorXd settle(std::size_t joint, Eigen::VectorXd& left, Eigen::MatrixXd* rows) const;
  double cost(const std::vector<std::vector<float>>& predicted, std::size_t ticks) const;

  const model::Entity& entity_;
  const Recording& recording_;
  const std::string type_;
  const survey::Watch& watch_;
  std::vector<std::size_t> joints_;
  std::vector<double> scale_;
  /// [joint][tick], counts: how far two twins are apart there that differ by their encoders' noise
  /// only, and the noise itself. Where a link rattles in its play, nobody can tell where it is.
  std::vector<std::vector<float>> sigma_;
  double nominal_v_;
  bool stopped_ = false;
  std::size_t expected_ = 0, gone_ = 0;
};

inline constexpr std::size_t kSettleTicks = 50;  ///< at the start: the twin finds its place

}  // namespace verp::identify
