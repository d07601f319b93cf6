#include "host/apps/tool/walk_report.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "host/apps/tool/stick_figure.hpp"
#include "host/apps/tool/walk_estimate.hpp"
#include "host/apps/tool/walk_load.hpp"
#include "host/apps/tool/walk_outside.hpp"
#include "host/apps/tool/walk_samples.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/session/asked.hpp"
#include "host/run/session/fault_names.hpp"
#include "host/study/report/maybe.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

std::string name_of(const Params& params) {
  return {params.name, ::strnlen(params.name, kNameLength)};
}

std::optional<double> percent(const std::optional<double>& share) {
  if (!share) return {};
  return 100 * *share;
}

bool turns(const WalkPlan& plan) {
  return plan.velocity.wz_mrad_s != 0;
}

double asked_turn_deg(const WalkPlan& plan, const sim::WalkMetrics& m) {
  return session::asked_way(plan.velocity, m.walk_s).turn_rad * 180 / std::numbers::pi;
}

/// An ordered curve is not drift.
std::string way_text(const WalkPlan& plan, const sim::WalkMetrics& m) {
  const std::string aside = fmt::format("{:+.3f} m to the left, ", m.lateral_drift_m);
  const std::string turn = fmt::format("{:+.1f} degrees", m.yaw_drift_deg);
  if (!turns(plan)) return aside + turn;
  return aside + turn + fmt::format(" of the {:+.0f} asked", asked_turn_deg(plan, m));
}

double asked_m_s(const WalkPlan& plan) {
  return 1e-4 * std::hypot(plan.velocity.vx_tenth_mm_s, plan.velocity.vy_tenth_mm_s);
}

/// Steady over ordered speed; empty with a turn, or without a steady cycle.
std::optional<double> share_of_asked(const WalkPlan& plan, const sim::WalkMetrics& m) {
  if (!m.speed_steady_m_s || asked_m_s(plan) <= 0 || plan.velocity.wz_mrad_s != 0) return {};
  return *m.speed_steady_m_s / asked_m_s(plan);
}

/// How much the speed exceeds the order, and why; empty without share_of_asked().
std::string beyond_asked(const WalkPlan& plan, const sim::WalkMetrics& m) {
  const std::optional<double> share = share_of_asked(plan, m);
  if (!share || !m.slip_steady_m_s) return {};
  const double all = 100 * (*share - 1);
  const double slip = 100 * *m.slip_steady_m_s / asked_m_s(plan);
  return fmt::format(
      "{:+.1f} %: {:+.1f} % is the carrying sole sliding, {:+.1f} % steps that end elsewhere than "
      "planned, as servos give way",
      all, slip, all - slip);
}

std::vector<report::Fact> facts(const WalkPlan& plan, const WalkResult& result) {
  using report::or_dash;
  const sim::WalkMetrics& m = result.metrics;
  const std::string beyond = beyond_asked(plan, m);
  return {
      {"Distance", fmt::format("{:.2f} m", m.distance_m),
       fmt::format("in {:.1f} s of gait{}", m.walk_s,
                   result.remark.empty() ? "" : "; " + result.remark)},
      {"Mean speed", or_dash(m.speed_mean_m_s, 3, " m/s"), "start, transition and finalisation"},
      {"Steady speed", or_dash(m.speed_steady_m_s, 3, " m/s"),
       fmt::format("commanded {:.3f} m/s{}{}", asked_m_s(plan), beyond.empty() ? "" : "; " + beyond,
                   m.speed_steady_m_s ? "" : "; no cycle was steady")},
      {"ZMP bias", or_dash(m.zmp_bias_mean_mm, 1, " mm"),
       "mean distance to the supporting sole's centre"},
      {plan.velocity.vy_tenth_mm_s != 0 || turns(plan) ? "Went aside" : "Lateral drift",
       fmt::format("{:+.3f} m", m.lateral_drift_m), "to the left of the starting line"},
      {turns(plan) ? "Turned" : "Yaw drift", fmt::format("{:+.1f}°", m.yaw_drift_deg),
       turns(plan) ? fmt::format("to the left; asked {:+.0f}°", asked_turn_deg(plan, m))
                   : "turned to the left"},
      {"Servo saturation", or_dash(percent(m.servo_saturation), 1, " %"),
       "of joint time at full duty"},
      transport_fact(m),
      {"Real-time factor", fmt::format("{:.1f}", result.real_time_factor()),
       "simulated over wall time"},
  };
}

std::string times(int count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

std::string falls_text(const WalkResult& result) {
  if (result.falls == 0 && result.get_ups == 0) return "without a fall";
  if (result.falls == 0) return "after it got up";
  return fmt::format("although it fell {}, and got up {}", times(result.falls),
                     times(result.get_ups));
}

std::string verdict(const WalkPlan& plan, const WalkResult& result, const Sweep& sweep) {
  constexpr double kAsAsked = 0.15;  // a larger deviation is in the first line
  const double gait_s = result.metrics.walk_s;
  if (result.interrupted) return fmt::format("Interrupted after {:.1f} s of gait", gait_s);
  if (!result.failure.empty()) return "Failed: " + result.failure;
  if (plan.stands) {
    return fmt::format("Stood {:.1f} s {}{}", plan.walk_s, falls_text(result),
                       gait_s > 0 ? fmt::format(", and stepped for {:.1f} s of them", gait_s) : "");
  }
  std::string text = fmt::format("Walked {:.1f} s {}", gait_s, falls_text(result));
  const std::optional<double> share = share_of_asked(plan, result.metrics);
  if (share && std::abs(*share - 1) > kAsAsked)
    text += fmt::format(", at {:.0f} % of the speed that was asked", 100 * *share);
  if (!result.remark.empty()) text += ", not as asked (remark)";
  if (!sweep.failure.empty()) text += "; failed: " + sweep.failure;
  if (sweep.interrupted) text += "; the sweep was interrupted";
  return text;
}

std::vector<std::pair<std::string, std::string>> provenance(const WalkPlan& plan,
                                                            const WalkResult& result) {
  const auto build = record::build_info();
  std::vector<std::pair<std::string, std::string>> rows = {
      {"robot", name_of(plan.params)},
      {"model file", plan.entity.file},
      {"seed", std::to_string(plan.twin.seed)},
      {"controller", driver_of(plan)},
      {"ticks", fmt::format("{} of {} us", result.ticks, plan.params.period_us)},
      {"digest", fmt::format("0x{:016x}", result.digest)},
  };
  for (const auto& [key, value] : build) rows.emplace_back(key, value);
  if (const std::string notes = session::fault_names(result.faults); !notes.empty()) {
    rows.emplace_back("controller's notes", notes);
  }
  return rows;
}

cli::Json changed_json(const WalkOptions& options) {
  cli::Json out = cli::Json::array();
  for (const auto& [name, value] : options.changed) out.push_back({name, value});
  return out;
}

std::string title(const WalkPlan& plan, const scenario::Orders& orders) {
  const std::string model = name_of(plan.params);
  const float cycle_s = plan.params.tuning.gait.cycle_s;
  if (plan.stands) return model + " stands";
  if (const auto* ahead = std::get_if<scenario::Ahead>(&orders))
    return fmt::format("{}: {:g} cm steps, {:g} s cycle", model,
                       100 * scenario::step_of(*ahead, plan.params.tuning.gait), cycle_s);
  return fmt::format("{}: velocity {}, {:g} s cycle", model, scenario::velocity_text(orders),
                     cycle_s);
}

/// The path from the body's pose at the gait's start.
std::vector<report::Point2> asked_points(const WalkPlan& plan, const report::Sample& start,
                                         double walk_s) {
  std::vector<report::Point2> points;
  const Eigen::Rotation2Dd turned(start.roll_pitch_yaw_rad[2]);
  for (const sim::Vec2& point : session::asked_way(plan.velocity, walk_s).point_m) {
    const sim::Vec2 at = turned * point;
    points.push_back({start.body.x_m + at.x(), start.body.y_m + at.y()});
  }
  return points;
}

std::string sweep_text(const std::vector<report::SweepRow>& rows) {
  std::string out =
      "\n  step       walked     speed        ZMP bias      without multibody correction\n";
  bool limited = false;
  for (const report::SweepRow& row : rows) {
    limited |= row.limited();
    out +=
        fmt::format("  {:<11}{:<11}{:<13}{:<14}{}\n", fmt::format("{:.1f} cm", 100 * row.step_m),
                    report::walked_step(row.with), report::or_dash(row.with.speed_m_s, 3, " m/s"),
                    report::bias_or_end(row.with), report::bias_or_end(row.without));
  }
  return limited ? out + "  " + report::kLimitedNote + "\n" : out;
}

cli::Json number_or_null(const std::optional<double>& value) {
  return value ? cli::Json(*value) : cli::Json();
}

cli::Json sweep_json(const std::vector<report::SweepRow>& rows) {
  using End = report::SweepWalk::End;
  cli::Json out = cli::Json::array();
  for (const report::SweepRow& row : rows) {
    out.push_back({{"step_m", row.step_m},
                   {"walked_step_m", number_or_null(row.with.step_m)},
                   {"walked_step_without_multibody_m", number_or_null(row.without.step_m)},
                   {"speed_m_s", number_or_null(row.with.speed_m_s)},
                   {"zmp_bias_mm", number_or_null(row.with.bias_mm)},
                   {"zmp_bias_without_multibody_mm", number_or_null(row.without.bias_mm)},
                   {"fallen", row.with.end == End::kFell},
                   {"fallen_without_multibody", row.without.end == End::kFell},
                   {"end", name_of(row.with.end)},
                   {"end_without_multibody", name_of(row.without.end)}});
  }
  return out;
}

}  // namespace

report::Run to_report(const WalkPlan& plan, const WalkOptions& options,
                      const scenario::Orders& orders, const WalkResult& result,
                      const Sweep& sweep) {
  report::Run run;
  run.model = name_of(plan.params);
  run.title = title(plan, orders);
  run.verdict = verdict(plan, result, sweep);
  run.good = result.good() && sweep.good();
  run.cycle_s = static_cast<double>(plan.params.tuning.gait.cycle_s);
  run.period_s = plan.params.period_us * 1e-6;
  for (const model::Joint& joint : plan.entity.joints) run.joints.push_back(joint.name);
  for (std::size_t side = 0; side < 2; ++side) {
    const LegParams& leg = plan.params.leg[side];
    if (leg.solver == LegSolver::kNone) continue;
    for (const std::uint8_t joint : leg.joint) {
      if (joint != kNoJoint) run.leg_joints[side].push_back(joint);
    }
  }
  const StickFigure figure(plan.entity, plan.params);
  run.limbs = figure.limbs();
  double start_s = -1;
  for (const sim::SeriesRow& row : result.series) {
    if (row.phase == 0) continue;
    if (start_s < 0) start_s = row.t_s;
    run.samples.push_back(to_sample(plan.params, row, start_s));
    run.samples.back().limb = figure.lines(row);
  }
  if (!run.samples.empty())
    run.asked = asked_points(plan, run.samples.front(), result.metrics.walk_s);
  run.changed = options.changed;
  run.steady = result.metrics.speed_steady_m_s.has_value();
  run.facts = facts(plan, result);
  run.bias_by_state_mm = result.metrics.zmp_bias_by_state_mm;
  run.bias_mean_mm = result.metrics.zmp_bias_mean_mm;
  run.speed_mean_m_s = result.metrics.speed_mean_m_s;
  run.sweep = sweep.rows;
  run.provenance = provenance(plan, result);
  return run;
}

std::string to_text(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                    const Sweep& sweep) {
  using report::or_dash;
  if (!plan.link.empty()) return outside_text(plan, result);
  const sim::WalkMetrics& m = result.metrics;
  std::string out = fmt::format("{}: {}\n", name_of(plan.params), verdict(plan, result, sweep));
  const auto line = [&](const char* name, const std::string& value) {
    out += fmt::format("  {:<18}{}\n", name, value);
  };
  for (const auto& [name, value] : options.changed) line("changed", name + " " + value);
  if (!result.remark.empty()) line("remark", result.remark);
  line("distance", fmt::format("{:.2f} m", m.distance_m));
  line("speed",
       m.speed_steady_m_s
           ? fmt::format("{} mean, {} steady", or_dash(m.speed_mean_m_s, 3, " m/s"),
                         or_dash(m.speed_steady_m_s, 3, " m/s"))
           : fmt::format("{} mean, - steady: no cycle was", or_dash(m.speed_mean_m_s, 3, " m/s")));
  if (const std::string text = beyond_asked(plan, m); !text.empty()) line("beyond asked", text);
  line("way asked", fmt::format("{:.2f} m", session::asked_way(plan.velocity, m.walk_s).length_m));
  line(plan.velocity.vy_tenth_mm_s != 0 || turns(plan) ? "went aside" : "drift", way_text(plan, m));
  line("ZMP bias", or_dash(m.zmp_bias_mean_mm, 1, " mm"));
  line("servo saturation", or_dash(percent(m.servo_saturation), 1, " %") + ", worst joint " +
                               or_dash(percent(m.servo_saturation_worst), 1, " %"));
  line("most torque", hardest_used(plan, m));
  line("cost of transport", transport_text(m));
  if (const std::string text = estimate_text(result.estimate); !text.empty())
    line("estimator", text);
  if (m.self_contact_ticks > 0) {
    line("touched itself", fmt::format("in {} ticks, last {} and {}", m.self_contact_ticks,
                                       m.self_contact_links[0], m.self_contact_links[1]));
  }
  line("real-time factor", fmt::format("{:.1f}", result.real_time_factor()));
  line("digest", fmt::format("0x{:016x} after {} ticks", result.digest, result.ticks));
  if (const std::string notes = session::fault_names(result.faults); !notes.empty())
    line("controller notes", notes);
  if (!sweep.rows.empty()) out += sweep_text(sweep.rows);
  return out;
}

cli::Json fall_story_json(const WalkResult& result) {
  cli::Json out = cli::Json::array();
  for (const session::RunEvent& each : result.fall_story)
    out.push_back({{"at_s", each.at_s}, {"what", each.what}});
  return out;
}

cli::Json to_json(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                  const Sweep& sweep) {
  const sim::WalkMetrics& m = result.metrics;
  cli::Json bias_by_state = cli::Json::array();
  for (const auto& bias_mm : m.zmp_bias_by_state_mm) {
    bias_by_state.push_back(number_or_null(bias_mm));
  }
  const cli::Json touched =
      m.self_contact_ticks > 0 ? cli::Json(m.self_contact_links) : cli::Json();
  cli::Json json = {{"model", name_of(plan.params)},
                    {"bus", plan.entity.bus},
                    {"seed", plan.twin.seed},
                    {"controller", driver_of(plan)},
                    {"ticks", result.ticks},
                    {"changed", changed_json(options)},
                    {"asked_s", plan.walk_s},
                    {"stands", plan.stands},
                    {"asked_m", session::asked_way(plan.velocity, m.walk_s).length_m},
                    {"asked_turn_deg", asked_turn_deg(plan, m)},
                    {"duration_s", plan.link.empty() ? m.walk_s : result.simulated_s},
                    {"distance_m", plan.link.empty() ? m.distance_m : way_of(plan, result).norm()},
                    {"speed_mean_m_s", number_or_null(m.speed_mean_m_s)},
                    {"speed_steady_m_s", number_or_null(m.speed_steady_m_s)},
                    {"slip_steady_m_s", number_or_null(m.slip_steady_m_s)},
                    {"ahead_m", m.ahead_m},
                    {"lateral_drift_m", m.lateral_drift_m},
                    {"yaw_drift_deg", m.yaw_drift_deg},
                    {"fallen", m.fallen},
                    {"falls", result.falls},
                    {"get_ups", result.get_ups},
                    {"fall_story", fall_story_json(result)},
                    {"interrupted", result.interrupted || sweep.interrupted},
                    {"failure", result.failure.empty() ? sweep.failure : result.failure},
                    {"remark", result.remark},
                    {"zmp_bias_mean_mm", number_or_null(m.zmp_bias_mean_mm)},
                    {"zmp_bias_by_state_mm", bias_by_state},
                    {"servo_saturation", number_or_null(m.servo_saturation)},
                    {"servo_saturation_worst", number_or_null(m.servo_saturation_worst)},
                    {"self_contact_ticks", m.self_contact_ticks},
                    {"self_contact_links", touched},
                    {"estimator", estimate_json(result.estimate)},
                    {"digest", digest_json(plan, result)},
                    {"notes", session::fault_names(result.faults)},
                    {"real_time_factor", result.real_time_factor()}};
  json.update(load_json(plan, m));
  if (!sweep.rows.empty()) json["sweep"] = sweep_json(sweep.rows);
  if (result.can) {
    json["can_bits_per_tick"] = result.can->bits_per_tick;
    json["can_bits_per_tick_without_stuffing"] = result.can->bare_bits_per_tick;
    json["can_overruns"] = result.can->overruns;
  }
  return json;
}

}  // namespace verp::tool
