#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "host/study/identify/numbers.hpp"
#include "host/study/identify/rig.hpp"
#include "host/study/survey/workers.hpp"

namespace verp::identify {

/// One servo type's numbers(), and behind them, in us, how much later servos act than the bus
/// timing says.
struct Estimate {
  std::vector<double> value, error;  ///< error: one standard deviation
  std::vector<bool> free;            ///< false: kept at its start value
  double rms_rad = 0;                ///< over the fitted ticks
};

/// Gives the twin the recorded goals and changes its numbers until its joints follow the robot's.
/// Gauss-Newton with damping and a robust weight.
class Fit {
 public:
  Fit(const model::Entity& entity, const Recording& recording, const std::string& type,
      const survey::Watch& watch);

  void improve(Estimate& estimate, std::size_t ticks, int rounds);
  /// Resets numbers that the motion does not determine, the least certain first.
  void leave_what_is_not_told(Estimate& estimate, std::size_t ticks);
  Estimate start() const;
  std::vector<std::vector<float>> predict(const Estimate& estimate, std::size_t ticks);
  /// The type's joints, ticks `from` to `to`.
  double rms_rad(const std::vector<std::vector<float>>& predicted, std::size_t from,
                 std::size_t to) const;
  const std::vector<std::size_t>& joints() const { return joints_; }
  bool stopped() const { return stopped_; }
  /// Ticks in all rounds, for the progress.
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
  /// [joint][tick], counts: encoder noise, and the distance of two twins with different noise,
  /// which is large where a link rattles in its backlash.
  std::vector<std::vector<float>> sigma_;
  double nominal_v_;
  bool stopped_ = false;
  std::size_t expected_ = 0, gone_ = 0;
};

inline constexpr std::size_t kSettleTicks = 50;  ///< while the twin settles

}  // namespace verp::identify
