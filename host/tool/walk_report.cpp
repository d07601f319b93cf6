#include "host/tool/walk_report.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "host/record/trace.hpp"
#include "host/tool/stick_figure.hpp"

namespace verp::tool {
namespace {

using model::Mat3;
using model::Vec3;

std::string name_of(const Params& params) {
  return {params.name, ::strnlen(params.name, kNameLength)};
}

Mat3 rotation_rpy(const Vec3& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

/// The ankle centre in the sole frame: Params gives the sole as the foot sees it.
Vec3 ankle_in_sole(const LegParams& leg) {
  Mat3 foot_sole;
  for (int i = 0; i < 9; ++i) foot_sole(i / 3, i % 3) = static_cast<double>(leg.sole_foot[i]);
  const Xyz& at = leg.sole_foot_m;
  return foot_sole.transpose() *
         -Vec3(static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z));
}

report::Point3 point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

void add_foot(const LegParams& leg, const sim::SeriesRow& row, std::size_t side,
              report::Sample& sample) {
  constexpr double kContact_n = sim::kContactForceN;
  const Mat3 rotation = rotation_rpy(row.sole_rpy_rad[side]);
  const Vec3& sole = row.sole_world_m[side];
  sample.ankle[side] = point(sole + rotation * ankle_in_sole(leg));
  const double front = static_cast<double>(leg.sole_front_m),
               back = -static_cast<double>(leg.sole_back_m);
  const double left = static_cast<double>(leg.sole_left_m),
               right = -static_cast<double>(leg.sole_right_m);
  const Vec3 corners[4] = {{front, left, 0}, {front, right, 0}, {back, right, 0}, {back, left, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 corner = sole + rotation * corners[i];
    sample.sole[side][i] = {corner.x(), corner.y()};
  }
  sample.contact[side] = row.foot_force_n[side] > kContact_n;
}

report::Sample to_sample(const Params& params, const sim::SeriesRow& row, double start_s) {
  report::Sample sample;
  sample.t_s = row.t_s - start_s;
  sample.phase = row.phase;
  sample.state = row.state;
  sample.carrying = row.stance;
  sample.body = point(row.body_world_m);
  sample.roll_pitch_yaw_rad = {row.body_rpy_rad.x(), row.body_rpy_rad.y(), row.body_rpy_rad.z()};
  for (std::size_t side = 0; side < 2; ++side) add_foot(params.leg[side], row, side, sample);
  if (row.zmp_valid) sample.zmp = report::Point2{row.zmp_world_m.x(), row.zmp_world_m.y()};
  if (row.zmp_planned_valid) {
    sample.zmp_planned = report::Point2{row.zmp_planned_world_m.x(), row.zmp_planned_world_m.y()};
  }
  if (row.zmp_valid && row.stance < 2) {
    const auto& sole = sample.sole[row.stance];
    const double x_m = (sole[0].x_m + sole[2].x_m) / 2, y_m = (sole[0].y_m + sole[2].y_m) / 2;
    sample.zmp_bias_mm = 1000 * std::hypot(sample.zmp->x_m - x_m, sample.zmp->y_m - y_m);
  }
  sample.joint_rad = row.joint_rad;
  sample.torque_use = row.torque_use;
  return sample;
}

std::vector<report::Fact> facts(const WalkPlan& plan, const WalkResult& result) {
  const sim::WalkMetrics& m = result.metrics;
  const double commanded_m_s =
      1e-4 * std::hypot(plan.velocity.vx_tenth_mm_s, plan.velocity.vy_tenth_mm_s);
  return {
      {"Distance", fmt::format("{:.2f} m", m.distance_m),
       fmt::format("in {:.1f} s of gait", m.walk_s)},
      {"Mean speed", fmt::format("{:.3f} m/s", m.speed_mean_m_s),
       "start, transition and finalisation"},
      {"Steady speed", fmt::format("{:.3f} m/s", m.speed_steady_m_s),
       fmt::format("commanded {:.3f} m/s", commanded_m_s)},
      {"ZMP bias", fmt::format("{:.1f} mm", m.zmp_bias_mean_mm),
       "mean distance to the supporting sole's centre"},
      {"Lateral drift", fmt::format("{:+.3f} m", m.lateral_drift_m),
       "to the left of the starting line"},
      {"Yaw drift", fmt::format("{:+.1f}°", m.yaw_drift_deg), "turned to the left"},
      {"Servo saturation", fmt::format("{:.1f} %", 100 * m.servo_saturation),
       "of joint time at full duty"},
      {"Real-time factor", fmt::format("{:.1f}", result.real_time_factor()),
       "simulated over wall time"},
  };
}

std::string verdict(const WalkResult& result) {
  if (result.interrupted)
    return fmt::format("Interrupted after {:.1f} s of gait", result.metrics.walk_s);
  if (!result.failure.empty()) return "Failed: " + result.failure;
  return fmt::format("Walked {:.1f} s without a fall", result.metrics.walk_s);
}

std::vector<std::pair<std::string, std::string>> provenance(const WalkPlan& plan,
                                                            const WalkResult& result) {
  const auto build = record::build_info();
  std::vector<std::pair<std::string, std::string>> rows = {
      {"robot", name_of(plan.params)},
      {"model file", plan.entity.file},
      {"seed", std::to_string(plan.seed)},
      {"controller", plan.board.empty() ? "this PC" : plan.board},
      {"ticks", fmt::format("{} of {} us", result.ticks, plan.params.period_us)},
      {"digest", fmt::format("0x{:016x}", result.digest)},
  };
  for (const auto& [key, value] : build) rows.emplace_back(key, value);
  if (const std::string notes = fault_names(result.faults); !notes.empty()) {
    rows.emplace_back("controller's notes", notes);
  }
  return rows;
}

std::string sweep_text(const std::vector<report::SweepRow>& sweep) {
  std::string out = "\n  step      speed        ZMP bias   without multibody correction\n";
  for (const report::SweepRow& row : sweep) {
    const auto bias = [](double mm, bool fallen) {
      return fallen ? std::string("fell") : fmt::format("{:.1f} mm", mm);
    };
    out +=
        fmt::format("  {:.1f} cm    {:.3f} m/s    {:>8}   {:>8}\n", 100 * row.step_m, row.speed_m_s,
                    bias(row.bias_mm, row.fallen), bias(row.bias_plain_mm, row.fallen_plain));
  }
  return out;
}

}  // namespace

report::Run to_report(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                      const std::vector<report::SweepRow>& sweep) {
  report::Run run;
  run.model = name_of(plan.params);
  run.title = options.velocity_text.empty()
                  ? fmt::format("{}: {:g} cm steps, {:g} s cycle", run.model, 100 * options.step_m,
                                options.cycle_s)
                  : fmt::format("{}: velocity {}, {:g} s cycle", run.model, options.velocity_text,
                                options.cycle_s);
  run.verdict = verdict(result);
  run.good = result.good();
  run.cycle_s = static_cast<double>(plan.params.tuning.gait.cycle_s);
  run.period_s = plan.params.period_us * 1e-6;
  for (const model::Joint& joint : plan.entity.joints) run.joints.push_back(joint.name);
  for (std::size_t side = 0; side < 2; ++side) {
    const LegParams& leg = plan.params.leg[side];
    if (leg.solver == LegSolver::kNone) continue;
    for (const std::uint8_t joint : leg.joint) run.leg_joints[side].push_back(joint);
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
  run.facts = facts(plan, result);
  run.bias_by_state_mm = result.metrics.zmp_bias_by_state_mm;
  run.bias_mean_mm = result.metrics.zmp_bias_mean_mm;
  run.speed_mean_m_s = result.metrics.speed_mean_m_s;
  run.speed_steady_m_s = result.metrics.speed_steady_m_s;
  run.sweep = sweep;
  run.provenance = provenance(plan, result);
  return run;
}

std::string to_text(const WalkPlan& plan, const WalkResult& result,
                    const std::vector<report::SweepRow>& sweep) {
  const sim::WalkMetrics& m = result.metrics;
  std::string out = fmt::format("{}: {}\n", name_of(plan.params), verdict(result));
  const auto line = [&](const char* name, const std::string& value) {
    out += fmt::format("  {:<18}{}\n", name, value);
  };
  line("distance", fmt::format("{:.2f} m", m.distance_m));
  line("speed",
       fmt::format("{:.3f} m/s mean, {:.3f} m/s steady", m.speed_mean_m_s, m.speed_steady_m_s));
  line("drift",
       fmt::format("{:+.3f} m to the left, {:+.1f} degrees", m.lateral_drift_m, m.yaw_drift_deg));
  line("ZMP bias", fmt::format("{:.1f} mm", m.zmp_bias_mean_mm));
  line("servo saturation", fmt::format("{:.1f} %, worst joint {:.1f} %", 100 * m.servo_saturation,
                                       100 * m.servo_saturation_worst));
  line("real-time factor", fmt::format("{:.1f}", result.real_time_factor()));
  line("digest", fmt::format("0x{:016x} after {} ticks", result.digest, result.ticks));
  if (const std::string notes = fault_names(result.faults); !notes.empty())
    line("controller notes", notes);
  if (!sweep.empty()) out += sweep_text(sweep);
  return out;
}

Json to_json(const WalkPlan& plan, const WalkResult& result,
             const std::vector<report::SweepRow>& sweep) {
  const sim::WalkMetrics& m = result.metrics;
  Json json = {{"model", name_of(plan.params)},
               {"seed", plan.seed},
               {"controller", plan.board.empty() ? "this PC" : plan.board},
               {"ticks", result.ticks},
               {"duration_s", m.walk_s},
               {"distance_m", m.distance_m},
               {"speed_mean_m_s", m.speed_mean_m_s},
               {"speed_steady_m_s", m.speed_steady_m_s},
               {"lateral_drift_m", m.lateral_drift_m},
               {"yaw_drift_deg", m.yaw_drift_deg},
               {"fallen", m.fallen},
               {"interrupted", result.interrupted},
               {"failure", result.failure},
               {"zmp_bias_mean_mm", m.zmp_bias_mean_mm},
               {"zmp_bias_by_state_mm", m.zmp_bias_by_state_mm},
               {"servo_saturation", m.servo_saturation},
               {"servo_saturation_worst", m.servo_saturation_worst},
               {"digest", fmt::format("0x{:016x}", result.digest)},
               {"notes", fault_names(result.faults)},
               {"real_time_factor", result.real_time_factor()}};
  if (sweep.empty()) return json;
  json["sweep"] = Json::array();
  for (const report::SweepRow& row : sweep) {
    json["sweep"].push_back({{"step_m", row.step_m},
                             {"speed_m_s", row.speed_m_s},
                             {"zmp_bias_mm", row.bias_mm},
                             {"zmp_bias_without_multibody_mm", row.bias_plain_mm},
                             {"fallen", row.fallen},
                             {"fallen_without_multibody", row.fallen_plain}});
  }
  return json;
}

}  // namespace verp::tool
