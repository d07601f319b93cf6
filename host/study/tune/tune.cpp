#include "host/study/tune/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/params.hpp"
#include "host/robot/model/stance.hpp"
#include "host/run/session/stride.hpp"
#include "host/study/tune/evolution.hpp"
#include "host/study/tune/space.hpp"
#include "host/study/tune/trial.hpp"

namespace verp::tune {
namespace {

constexpr double kLimit_s = 10;     // length of the walk that finds a limit
constexpr double kFirstStep = 0.5;  // in steps of each axis
constexpr double kOffSpeed = 0.1;   // largest speed error of a walk that counts
// The file's robot and a random one.
constexpr int kTrials = 2;

class Judge {
 public:
  Judge(const session::WalkPlan& plan, const sim::WorldOptions& world, const Options& options,
        const survey::Watch& watch, int walks)
      : plan_(plan), world_(world), options_(options), watch_(watch), all_(walks) {
    plan_.velocity = ahead(options.speed_m_s);
  }

  /// Mean costs per Tuning, over the search's walks.
  std::vector<double> costs(const std::vector<Tuning>& tunings, std::uint64_t seed) {
    std::vector<double> costs(tunings.size() * kTrials, kCannotStand);
    walk(costs.size(), [&](std::size_t piece, const std::function<bool()>& stop) {
      const session::WalkPlan plan = with(tunings[piece / kTrials]);
      if (!model::can_stand(plan.params)) return;
      const bool varied = piece % kTrials != 0;
      const Trial trial{.walk_s = options_.try_s, .seed = seed, .varied = varied};
      costs[piece] =
          cost_of(try_walk(plan, world_, trial, stop), options_.try_s, options_.speed_m_s);
    });
    std::vector<double> mean(tunings.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const auto from = costs.begin() + static_cast<std::ptrdiff_t>(i * kTrials);
      mean[i] = std::accumulate(from, from + kTrials, 0.0) / kTrials;
    }
    return mean;
  }

  Check check(const Tuning& tuning) {
    const session::WalkPlan plan = with(tuning);
    std::vector<session::WalkResult> results(static_cast<std::size_t>(options_.checks));
    walk(results.size(), [&](std::size_t i, const std::function<bool()>& stop) {
      const Trial trial{.walk_s = options_.check_s, .seed = kCheckSeed + i, .varied = true};
      results[i] = try_walk(plan, world_, trial, stop);
    });
    return sum_up(results, options_.speed_m_s);
  }

  int walks() const { return done_; }
  bool stopped() const { return stopped_; }
  session::WalkPlan with(const Tuning& tuning) const {
    session::WalkPlan plan = plan_;
    plan.params.tuning = tuning;
    return plan;
  }

 private:
  void walk(std::size_t pieces,
            const std::function<void(std::size_t, const std::function<bool()>&)>& one) {
    if (stopped_) return;
    survey::Watch watch = watch_;
    watch.went_on = [&](double share) {
      if (!watch_.went_on) return;
      watch_.went_on(std::min(1.0, (done_ + share * static_cast<double>(pieces)) / all_));
    };
    survey::Workers workers(watch, pieces);
    workers.run(pieces, [&](std::size_t piece) {
      one(piece, [&] { return workers.stopped(); });
      workers.step_done();
    });
    done_ += static_cast<int>(pieces);
    stopped_ = workers.stopped();
  }

  session::WalkPlan plan_;
  const sim::WorldOptions& world_;
  const Options& options_;
  const survey::Watch& watch_;
  const int all_;
  int done_ = 0;
  bool stopped_ = false;
};

std::size_t least(const std::vector<double>& costs) {
  return static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

std::vector<Number> changes(const Tuning& was, const Tuning& now) {
  std::vector<Number> numbers;
  for (int id = 0; id < kTuningCount; ++id) {
    const float before = tuning_value(was, id), after = tuning_value(now, id);
    if (before == after) continue;
    numbers.push_back({.id = id,
                       .name = model::tuning_names()[static_cast<std::size_t>(id)],
                       .was = before,
                       .now = after});
  }
  return numbers;
}

/// More robots walk, or as many with less bias.
bool better(const Check& one, const Check& other) {
  if (one.walked != other.walked) return one.walked > other.walked;
  return one.bias_mm.value_or(1e9) < other.bias_mm.value_or(1e9);
}

/// Rounds to three digits, for people.
Tuning rounded(const Tuning& from, const Tuning& was) {
  Tuning to = from;
  for (const Number& each : changes(was, from))
    set_tuning_value(to, each.id, std::stof(fmt::format("{:.3g}", each.now)));
  return to;
}

}  // namespace

Check sum_up(const std::vector<session::WalkResult>& results, double asked_m_s) {
  Check check{.walked = 0, .of = static_cast<int>(results.size()), .bias_mm = {}, .speed_m_s = {}};
  double bias = 0, speed = 0;
  for (const session::WalkResult& each : results) {
    const double steady_m_s = each.metrics.speed_steady_m_s.value_or(0);
    if (!each.good() || std::abs(steady_m_s / asked_m_s - 1) > kOffSpeed) continue;
    ++check.walked;
    bias += each.metrics.zmp_bias_mean_mm.value_or(0);
    speed += steady_m_s;
  }
  if (check.walked == 0) return check;
  check.bias_mm = bias / check.walked;
  check.speed_m_s = speed / check.walked;
  return check;
}

Result tune(const session::WalkPlan& plan, const sim::WorldOptions& world, const Options& options,
            const survey::Watch& watch) {
  const Space space(plan.params);
  const Tuning& was = plan.params.tuning;
  const std::vector<Tuning> looks = space.first_look(options.speed_m_s);
  const int walks =
      kTrials * (static_cast<int>(looks.size()) + options.children * options.generations) +
      2 * options.checks;
  Judge judge(plan, world, options, watch, walks);
  std::uint64_t seed = kSearchSeed;
  const Tuning& begin = looks[least(judge.costs(looks, seed++))];
  Evolution evolution(space.at(begin), kFirstStep, options.children, options.seed);
  for (int generation = 0; generation < options.generations && !judge.stopped(); ++generation) {
    std::vector<Tuning> tunings;
    for (const Eigen::VectorXd& at : evolution.ask())
      tunings.push_back(space.tuning(at, options.speed_m_s));
    const std::vector<double> costs = judge.costs(tunings, seed++);
    if (!judge.stopped()) evolution.tell(costs);
  }
  Result result;
  const Tuning found = rounded(space.tuning(evolution.mean(), options.speed_m_s), was);
  result.before = judge.check(was);
  result.after = judge.check(found);
  result.walks = judge.walks();
  result.interrupted = judge.stopped();
  if (result.interrupted) return result;
  if (better(result.after, result.before)) {
    result.numbers = changes(was, found);
  } else {
    result.after = result.before;
  }
  if (result.after.walked == 0)
    result.limit = limit_of(judge.with(found), world, options.speed_m_s);
  return result;
}

std::string limit_of(session::WalkPlan plan, const sim::WorldOptions& world, double speed_m_s) {
  constexpr double kShortened = 0.95, kWorn = 0.2;
  const Params& params = plan.params;
  const GaitTuning& gait = params.tuning.gait;
  if (!model::can_stand(params)) {
    return fmt::format("reach: the legs cannot stand with the hip {:.3f} m above the ankle",
                       gait.hip_height_m);
  }
  plan.velocity = ahead(speed_m_s);
  const session::Fastest fastest = session::fastest_joint(params, plan.velocity);
  if (fastest.share > session::kMostSpeedShare) {
    return fmt::format(
        "servo speed: {} would have to turn at {:.0f} % of its limit for {:g} m/s in cycles of "
        "{:g} s",
        fastest.joint, 100 * fastest.share, speed_m_s, gait.cycle_s);
  }
  const session::WalkResult walked =
      try_walk(plan, world, {.walk_s = kLimit_s, .seed = kSearchSeed, .varied = false}, {});
  const double step_m = 0.5 * speed_m_s * static_cast<double>(gait.cycle_s);
  if (walked.longest_step_m < kShortened * step_m && walked.metrics.walk_s > 0.5 * kLimit_s) {
    return fmt::format("reach: steps of {:.0f} mm are needed, and the legs make {:.0f}",
                       1e3 * step_m, 1e3 * walked.longest_step_m);
  }
  if (walked.metrics.servo_saturation_worst.value_or(0) > kWorn) {
    const int joint = walked.metrics.servo_saturation_worst_joint;
    return fmt::format("servo strength: {} gave all it has in {:.0f} % of the time",
                       plan.entity.joints[static_cast<std::size_t>(joint)].name,
                       100 * *walked.metrics.servo_saturation_worst);
  }
  return fmt::format(
      "balance: {} (the robot as its file has it, seed {})",
      walked.failure.empty() ? "it walks alone, and other robots of its kind fall" : walked.failure,
      kSearchSeed);
}

}  // namespace verp::tune
