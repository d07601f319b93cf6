#include "host/author/action/record.hpp"

#include <algorithm>
#include <cmath>

#include "common/control/step.hpp"
#include "common/gait/gait.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/counts.hpp"
#include "common/model/leg.hpp"

namespace verp::action {
namespace {

[[noreturn]] void fail(const record::Trace& trace, const std::string& what,
                       const std::string& fix) {
  throw model::LoadError(trace.file.string(), 0, what, fix);
}

double in_ms(double time_s) {
  return 1e-3 * std::round(1e3 * time_s);
}

/// Planned leg poses at the time of the goals.
void add_planned(const Params& params, const State& state, FrameText& frame) {
  const gait::Posture posture = gait::posture_before(params, state.tuning, state.gait, 0);
  for (int side = 0; side < kFeet; ++side) {
    const LegParams& leg = params.leg[side];
    float previous_rad[kLegJoints];
    model::read_leg(leg, state.limit.goal_rad, previous_rad);
    const kinematics::LegAngles legs =
        kinematics::solve_leg(params, leg, gait::sole_in_body(posture, side), previous_rad);
    for (int k = 0; k < kLegJoints; ++k) {
      if (!model::has(leg, k)) continue;
      frame.goals.push_back(
          {params.joint[leg.joint[k]].name, false, static_cast<double>(legs.angle_rad[k]), 0});
    }
  }
}

}  // namespace

Document record_joints(const record::Trace& trace, const RecordOptions& options) {
  Document document;
  document.name = options.name;
  document.note = "Recorded from " + trace.file.filename().string();
  double last_s = -1e9;
  for (const TickRecord& tick : trace.ticks) {
    const double time_s = tick.inputs.tick * trace.period_s();
    if (time_s < options.from_s - 1e-9 || time_s > options.to_s + 1e-9) continue;
    if (time_s - last_s < options.every_s - 1e-9) continue;
    FrameText frame;
    // The pose before the first frame is unknown: 1 s.
    frame.time_s = document.frames.empty() ? 1.0 : in_ms(time_s - last_s);
    last_s = time_s;
    for (int j = 0; j < trace.params.joint_count; ++j) {
      const JointParams& joint = trace.params.joint[j];
      const float angle = model::angle_of(joint, tick.inputs.position_count[j]);
      frame.goals.push_back(
          {joint.name, false,
           static_cast<double>(math::clamp(angle, joint.lower_rad, joint.upper_rad)), 0});
    }
    if (document.frames.empty()) frame.balance = false;  // measured angles already contain the sag
    document.frames.push_back(frame);
  }
  if (document.frames.empty())
    fail(trace, "has no tick in that time", "give another --from and --to");
  return document;
}

/// The last state may be less than a frame's minimum before the next cycle; the longest frame gives
/// the added time back.
void give_back(double excess_s, std::vector<FrameText>& frames) {
  const auto longest =
      std::max_element(frames.begin() + 1, frames.end(),
                       [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  longest->time_s = std::max(1e-3 * kLeastFrame_ms, in_ms(longest->time_s - excess_s));
}

Document record_gait(const record::Trace& trace, const std::string& name, int cycles) {
  constexpr int kStates = 16, kCyclesBefore = 3;
  Document document;
  document.name = name;
  document.note = "The gait's cycle of 16 states, from " + trace.file.filename().string();
  const Library actions = trace.library();
  State state = trace.start();
  Outputs outputs;
  int last = -1, seen = 0;
  double last_s = 0, excess_s = 0;
  for (const TickRecord& tick : trace.ticks) {
    step(trace.params, actions, state, tick.inputs, outputs);
    const bool walks = outputs.gait_phase == static_cast<std::uint8_t>(gait::Phase::kTransition);
    if (!walks) document.frames.clear(), seen = 0, last = -1, excess_s = 0;
    if (!walks || outputs.gait_state == last) continue;
    if (outputs.gait_state < last) ++seen;
    last = outputs.gait_state;
    if (seen < kCyclesBefore) continue;
    const double time_s = tick.inputs.tick * trace.period_s();
    FrameText frame;
    frame.label = "state" + std::to_string(last);
    const double since_s = in_ms(time_s - last_s);
    frame.time_s = document.frames.empty() ? 0.6 : std::max(1e-3 * kLeastFrame_ms, since_s);
    if (!document.frames.empty()) excess_s += frame.time_s - since_s;
    last_s = time_s;
    if (outputs.stance <= 2) frame.stance = static_cast<Stance>(outputs.stance);
    add_planned(trace.params, state, frame);
    // The 17th state closes the loop.
    if (document.frames.size() == kStates) frame.label = "again";
    document.frames.push_back(frame);
    if (document.frames.size() <= kStates) continue;
    give_back(excess_s, document.frames);
    document.frames.back().repeat = Repeat{cycles, {document.frames[1].label, 0}};
    return document;
  }
  fail(trace, "has no whole cycle of a walk", "record a longer one with verp walk --record");
}

}  // namespace verp::action
