#include "host/study/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"
#include "host/study/identify/fit.hpp"

namespace verp::identify {
namespace {

constexpr double kLeast_s = 5;
constexpr double kRough_s = 10;  ///< for the first rounds
constexpr int kRoughRounds = 6, kRounds = 7;
constexpr double kStill_rad = 0.02;  ///< rms; a joint below it does not move
constexpr const char* kMotion =
    "record the motion that `verp identify --motion identify.action` makes";

std::string type_of(const model::Entity& entity, const std::string& asked) {
  const std::vector<std::string> types = types_of(entity);
  std::string list;
  for (const std::string& each : types) list += (list.empty() ? "" : ", ") + each;
  if (asked.empty() && types.size() == 1) return types.front();
  if (asked.empty()) {
    throw model::LoadError(entity.file, 0, "the robot has servos of several types",
                           "choose one by --type: " + list);
  }
  if (servo_of(entity, asked) == nullptr) {
    throw model::LoadError(entity.file, 0, "the robot has no servo of type '" + asked + "'",
                           "choose one of: " + list);
  }
  return asked;
}

void require_same_robot(const model::Entity& entity, const record::Trace& trace) {
  const Params& params = trace.params;
  const std::size_t most = std::max<std::size_t>(entity.joints.size(), params.joint_count);
  for (std::size_t j = 0; j < most; ++j) {
    const std::string here = j < entity.joints.size() ? entity.joints[j].name : "missing";
    const std::string there =
        j < params.joint_count
            ? std::string(params.joint[j].name, ::strnlen(params.joint[j].name, kNameLength))
            : "missing";
    if (model::short_name(here) == there) continue;
    throw record::TraceError(
        trace.file,
        fmt::format("of another robot: joint {} is '{}', here it is '{}'", j, there, here),
        "name the robot that was recorded by --robot");
  }
}

void require_motion(const record::Trace& trace, const Recording& recording, const Fit& fit) {
  if (recording.length_s() < kLeast_s) {
    throw record::TraceError(
        trace.file,
        fmt::format("its servos had all of their strength for {:.1f} s; {:.0f} s are needed",
                    recording.length_s(), kLeast_s),
        kMotion);
  }
  double most_rad = 0;
  for (const std::size_t j : fit.joints()) {
    double sum = 0, squares = 0;
    const double zero = recording.ticks.front().position[j];
    for (const Recording::Tick& tick : recording.ticks) {
      sum += tick.position[j] - zero;
      squares += (tick.position[j] - zero) * (tick.position[j] - zero);
    }
    const auto count = static_cast<double>(recording.ticks.size());
    const double rms = std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
    const double per_rad = std::abs(static_cast<double>(recording.params.joint[j].counts_per_rad));
    most_rad = std::max(most_rad, rms / per_rad);
  }
  if (most_rad < kStill_rad) {
    throw record::TraceError(trace.file, "no servo of that type moves", kMotion);
  }
}

}  // namespace

Result identify(const model::Entity& entity, const record::Trace& trace, const Options& options,
                const survey::Watch& watch) {
  require_same_robot(entity, trace);
  Result result;
  result.type = type_of(entity, options.type);
  const Recording recording = recording_of(trace);
  Fit fit(entity, recording, result.type, watch);
  require_motion(trace, recording, fit);
  const std::size_t all = recording.ticks.size();
  const auto fitted = static_cast<std::size_t>(static_cast<double>(all) * (1 - options.held_out));
  const auto rough = std::min(fitted, static_cast<std::size_t>(kRough_s / recording.period_s()));
  const Estimate before = fit.start();
  Estimate estimate = before;
  const bool more = 2 * rough <= fitted;
  fit.expect(kRoughRounds * rough + (more ? kRounds * fitted : 0));
  fit.improve(estimate, more ? rough : fitted, kRoughRounds);
  if (more) fit.improve(estimate, fitted, kRounds);
  fit.leave_what_is_not_told(estimate, fitted);
  const auto was = fit.predict(before, all), now = fit.predict(estimate, all);
  result.interrupted = fit.stopped();
  if (result.interrupted) return result;
  result.fitted = {fit.rms_rad(was, 0, fitted), fit.rms_rad(now, 0, fitted)};
  result.held_out = {fit.rms_rad(was, fitted, all), fit.rms_rad(now, fitted, all)};
  result.length_s = recording.length_s();
  result.fitted_until_s = recording.period_s() * static_cast<double>(fitted);
  for (const std::size_t j : fit.joints()) result.joints.push_back(entity.joints[j].name);
  result.servo = *servo_of(entity, result.type);
  for (std::size_t i = 0; i < estimate.value.size(); ++i) {
    const bool delay = i == numbers().size();
    Row& row = result.rows.emplace_back();
    row.name = delay ? "goal_delay_us" : numbers()[i].name;
    row.unit = delay ? "us" : numbers()[i].unit;
    row.meaning = delay ? "from a goal's arrival until its servo acts" : numbers()[i].meaning;
    row.was = before.value[i];
    row.now = delay ? std::max(0.0, estimate.value[i]) : estimate.value[i];
    row.error = estimate.error[i];
    row.determined = estimate.free[i];
    if (delay) {
      result.servo.goal_delay_s = 1e-6 * row.now;
    } else {
      numbers()[i].set(result.servo, row.now);
    }
  }
  return result;
}

}  // namespace verp::identify
