#include "host/study/identify/fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace verp::identify {
namespace {

constexpr double kTry = 0.25;        ///< difference step, part of each number's scale, both ways
constexpr double kFar = 4;           ///< sigmas: larger errors have other causes
constexpr double kLeastSigma = 0.5;  ///< counts: encoder noise and rounding
constexpr std::size_t kAround = 10;  ///< ticks on either side for averaging chance
constexpr double kMuchWorse = 1.03;  ///< a step may raise the cost by this; chance raises it less
constexpr std::size_t kBlock = 50;   ///< ticks with correlated errors
constexpr double kFurthest = 16;     ///< most that go_on() lengthens a step

// Geman-McClure: bounds outliers.
double weight(double residual) {
  const double part = 1 + residual * residual / (kFar * kFar);
  return 1 / (part * part);
}

double loss(double residual) {
  return residual * residual / (1 + residual * residual / (kFar * kFar));
}

}  // namespace

struct Fit::Normal {
  Eigen::MatrixXd information, scatter;
  Eigen::VectorXd gradient;
  double cost = 0;
};

Fit::Fit(const model::Entity& entity, const Recording& recording, const std::string& type,
         const survey::Watch& watch)
    : entity_(entity), recording_(recording), type_(type), watch_(watch) {
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    if (entity.joints[j].servo.type == type && entity.joints[j].follows < 0) joints_.push_back(j);
  }
  const model::Servo& servo = *servo_of(entity, type);
  for (const Number& number : numbers()) scale_.push_back(number.scale(servo));
  scale_.push_back(1000);
  nominal_v_ = recording.supply_v > 0 ? recording.supply_v : servo.nominal_v;
}

Estimate Fit::start() const {
  Estimate estimate;
  const model::Servo& servo = *servo_of(entity_, type_);
  for (const Number& number : numbers()) estimate.value.push_back(number.get(servo));
  estimate.value.push_back(1e6 * servo.goal_delay_s);
  estimate.error.assign(estimate.value.size(), 0);
  estimate.free.assign(estimate.value.size(), true);
  return estimate;
}

model::Entity Fit::with(const std::vector<double>& value) const {
  model::Entity entity = entity_;
  for (model::Joint& joint : entity.joints) {
    if (joint.servo.type == type_) joint.servo.goal_delay_s = 0;  // the rig adds it
  }
  for (std::size_t i = 0; i < numbers().size(); ++i) {
    set_number(entity, type_, numbers()[i], value[i]);
  }
  return entity;
}

Simulated Fit::run(const std::vector<double>& value, int delay_steps, std::size_t ticks,
                   std::uint64_t seed) const {
  return simulate(
      with(value), recording_,
      {.delay_steps = delay_steps, .supply_v = nominal_v_, .ticks = ticks, .seed = seed});
}

void Fit::see_chance(const Simulated& one, const Simulated& other, std::size_t ticks) {
  sigma_.assign(entity_.joints.size(), std::vector<float>(ticks, 1));
  for (const std::size_t j : joints_) {
    std::vector<double> sum(ticks + 1, 0);
    for (std::size_t i = 0; i < ticks; ++i) {
      const double apart = static_cast<double>(one.count[j][i]) - other.count[j][i];
      sum[i + 1] = sum[i] + apart * apart;
    }
    for (std::size_t i = 0; i < ticks; ++i) {
      const std::size_t from = i > kAround ? i - kAround : 0, to = std::min(i + kAround + 1, ticks);
      const double chance = (sum[to] - sum[from]) / static_cast<double>(to - from);
      sigma_[j][i] = static_cast<float>(std::sqrt(kLeastSigma * kLeastSigma + 2 * chance));
    }
  }
}

std::vector<std::vector<float>> Fit::predict(const Estimate& estimate, std::size_t ticks) {
  const double steps = estimate.value[delay()] / kStep_us;
  const int whole = static_cast<int>(std::lround(steps));
  const double part = steps - whole;
  const int side = part > 0 ? 1 : -1;
  Simulated sims[2];
  survey::Workers workers(watch_, 2);
  workers.run(part != 0 ? 2 : 1, [&](std::size_t piece) {
    sims[piece] = run(estimate.value, whole + side * static_cast<int>(piece), ticks);
    workers.step_done();
  });
  stopped_ = stopped_ || workers.stopped();
  if (part != 0 && !stopped_) {
    for (std::size_t j = 0; j < sims[0].count.size(); ++j) {
      for (std::size_t i = 0; i < ticks; ++i) {
        sims[0].count[j][i] +=
            static_cast<float>(std::abs(part)) * (sims[1].count[j][i] - sims[0].count[j][i]);
      }
    }
  }
  return sims[0].count;
}

/// Residual less the encoder's zero error. `left`: counts on entry, sigmas on return. Returns
/// weights.
Eigen::VectorXd Fit::settle(std::size_t joint, Eigen::VectorXd& left, Eigen::MatrixXd* rows) const {
  const Eigen::Index size = left.size();
  Eigen::VectorXd sure(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::size_t tick = kSettleTicks + static_cast<std::size_t>(i);
    const bool read = (recording_.ticks[tick].fresh >> joint & 1U) != 0;
    sure[i] = read ? 1 / static_cast<double>(sigma_[joint][tick]) : 0;
  }
  Eigen::VectorXd counts = sure.cwiseAbs2();
  for (int round = 0; round < 3; ++round) {
    const double zero = counts.sum() > 0 ? counts.dot(left) / counts.sum() : 0;
    left.array() -= zero;
    for (Eigen::Index i = 0; i < size; ++i)
      counts[i] = sure[i] * sure[i] * weight(sure[i] * left[i]);
  }
  if (rows != nullptr && counts.sum() > 0) {
    const Eigen::RowVectorXd mean = counts.transpose() * *rows / counts.sum();
    rows->rowwise() -= mean;
    *rows = sure.asDiagonal() * *rows;
  }
  left = left.cwiseProduct(sure);
  return left.unaryExpr([](double each) { return weight(each); });
}

double Fit::cost(const std::vector<std::vector<float>>& predicted, std::size_t ticks) const {
  double sum = 0;
  for (const std::size_t j : joints_) {
    Eigen::VectorXd left(static_cast<Eigen::Index>(ticks - kSettleTicks));
    for (std::size_t i = kSettleTicks; i < ticks; ++i) {
      left[static_cast<Eigen::Index>(i - kSettleTicks)] =
          recording_.ticks[i].position[j] - static_cast<double>(predicted[j][i]);
    }
    settle(j, left, nullptr);
    sum += left.unaryExpr([](double each) { return loss(each); }).sum();
  }
  return sum;
}

double Fit::rms_rad(const std::vector<std::vector<float>>& predicted, std::size_t from,
                    std::size_t to) const {
  double sum = 0;
  std::size_t samples = 0;
  for (const std::size_t j : joints_) {
    const double rad = 2 * std::numbers::pi / entity_.joints[j].servo.counts_per_rev;
    for (std::size_t i = std::max(from, kSettleTicks); i < to; ++i) {
      const Recording::Tick& tick = recording_.ticks[i];
      if ((tick.fresh >> j & 1U) == 0) continue;
      const double error = rad * (tick.position[j] - static_cast<double>(predicted[j][i]));
      sum += error * error;
      ++samples;
    }
  }
  return samples > 0 ? std::sqrt(sum / static_cast<double>(samples)) : 0;
}

Fit::Normal Fit::linearise(const Estimate& estimate, std::size_t ticks) {
  const std::size_t n = estimate.value.size();
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < n; ++i) {
    if (estimate.free[i]) columns.push_back(i);
  }
  const int whole = static_cast<int>(std::lround(estimate.value[delay()] / kStep_us));
  const double part = estimate.value[delay()] / kStep_us - whole;
  // Two twins per column (more and less), and two at the estimate with different noise.
  const std::size_t base = 2 * columns.size();
  std::vector<Simulated> sims(base + 2);
  std::vector<double> at(base);
  survey::Watch watch = watch_;
  watch.went_on = [&](double share) {
    if (!watch_.went_on || expected_ == 0) return;
    const double gone = static_cast<double>(gone_) + share * static_cast<double>(ticks);
    watch_.went_on(std::min(1.0, gone / static_cast<double>(expected_)));
  };
  survey::Workers workers(watch, sims.size());
  workers.run(sims.size(), [&](std::size_t piece) {
    workers.step_done();
    std::vector<double> value = estimate.value;
    if (piece < base) {
      const std::size_t i = columns[piece / 2];
      const int side = piece % 2 == 0 ? 1 : -1;
      if (i == delay()) {
        at[piece] = side * static_cast<double>(kStep_us);
        sims[piece] = run(value, whole + side, ticks);
        return;
      }
      at[piece] = value[i] =
          std::clamp(value[i] + side * kTry * scale_[i], numbers()[i].low, numbers()[i].high);
    }
    sims[piece] = run(value, whole, ticks, piece < base ? 1 : 2 + piece - base);
  });
  Normal normal;
  gone_ += ticks;
  stopped_ = stopped_ || workers.stopped();
  if (stopped_) return normal;
  const auto size = static_cast<Eigen::Index>(columns.size());
  normal.information = normal.scatter = Eigen::MatrixXd::Zero(size, size);
  normal.gradient = Eigen::VectorXd::Zero(size);
  const Simulated &now = sims[base], &other = sims[base + 1];
  see_chance(now, other, ticks);
  const auto length = static_cast<Eigen::Index>(ticks - kSettleTicks);
  for (const std::size_t j : joints_) {
    Eigen::VectorXd left(length);
    Eigen::MatrixXd rows(length, size);
    for (Eigen::Index k = 0; k < length; ++k) {
      const std::size_t i = kSettleTicks + static_cast<std::size_t>(k);
      double where = 0.5 * (static_cast<double>(now.count[j][i]) + other.count[j][i]);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const double slope =
            (static_cast<double>(sims[2 * c].count[j][i]) - sims[2 * c + 1].count[j][i]) /
            (at[2 * c] - at[2 * c + 1]);
        rows(k, static_cast<Eigen::Index>(c)) = slope * scale_[columns[c]];
        if (columns[c] == delay()) where += slope * part * kStep_us;
      }
      left[k] = recording_.ticks[i].position[j] - where;
    }
    const Eigen::VectorXd counts = settle(j, left, &rows);
    const Eigen::MatrixXd pulls = counts.cwiseProduct(left).asDiagonal() * rows;
    normal.information += rows.transpose() * counts.asDiagonal() * rows;
    normal.gradient += pulls.colwise().sum().transpose();
    for (Eigen::Index k = 0; k < length; k += kBlock) {
      const Eigen::VectorXd block =
          pulls.middleRows(k, std::min<Eigen::Index>(kBlock, length - k)).colwise().sum();
      normal.scatter += block * block.transpose();
    }
    normal.cost += left.unaryExpr([](double each) { return loss(each); }).sum();
  }
  return normal;
}

/// `by`: free numbers in their scales, within bounds.
Estimate Fit::moved(const Estimate& from, const Eigen::VectorXd& by) const {
  Estimate to = from;
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < from.value.size(); ++i) {
    if (!from.free[i]) continue;
    const double value = from.value[i] + by[column++] * scale_[i];
    to.value[i] = i == delay() ? std::max(value, double{kLeastDelay} * kStep_us)
                               : std::clamp(value, numbers()[i].low, numbers()[i].high);
  }
  return to;
}

/// Doubles the step while the cost falls: chance in the slopes looks like information and makes
/// steps too short.
Estimate Fit::go_on(const Estimate& from, const Eigen::VectorXd& by, Estimate best,
                    double cost_best, std::size_t ticks) {
  for (double times = 2; times <= kFurthest && !stopped_; times *= 2) {
    const Estimate next = moved(from, times * by);
    const double cost_next = cost(predict(next, ticks), ticks);
    if (!(cost_next < cost_best)) break;
    best = next;
    cost_best = cost_next;
  }
  return best;
}

void Fit::improve(Estimate& estimate, std::size_t ticks, int rounds) {
  double damping = 1e-3;
  for (int round = 0; round < rounds && !stopped_; ++round) {
    const Normal normal = linearise(estimate, ticks);
    if (stopped_) return;
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < estimate.value.size(); ++i) {
      if (estimate.free[i]) columns.push_back(i);
    }
    const Eigen::MatrixXd inverse = normal.information.inverse();
    const Eigen::MatrixXd covariance = inverse * normal.scatter * inverse;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto at = static_cast<Eigen::Index>(c);
      estimate.error[columns[c]] =
          std::sqrt(std::max(covariance(at, at), 0.0)) * scale_[columns[c]];
    }
    bool better = false;
    for (int attempt = 0; attempt < 4 && !better && !stopped_; ++attempt) {
      Eigen::MatrixXd damped = normal.information;
      damped.diagonal() *= 1 + damping;
      const Eigen::VectorXd by = damped.ldlt().solve(normal.gradient);
      const Estimate next = moved(estimate, by);
      const double cost_next = cost(predict(next, ticks), ticks);
      if (stopped_) return;
      better = cost_next < kMuchWorse * normal.cost;
      if (better) {
        const Estimate further = go_on(estimate, by, next, cost_next, ticks);
        if (stopped_) return;
        estimate = further;
        damping = std::max(damping / 10, 1e-6);
        double far = 0;
        for (std::size_t c = 0; c < columns.size(); ++c) {
          const std::size_t i = columns[c];
          far = std::max(far, std::abs(by[static_cast<Eigen::Index>(c)]) * scale_[i] /
                                  std::max(estimate.error[i], 0.003 * scale_[i]));
        }
        if (far < 1) return;
      } else {
        damping = std::max(10 * damping, 1e-2);
      }
    }
    if (!better) return;
  }
}

}  // namespace verp::identify
