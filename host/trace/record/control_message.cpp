#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/trace/record/ros_messages.hpp"

namespace verp::record::ros {

const std::string_view kControlSchema = R"({
 "title": "verp.Control", "type": "object",
 "properties": {
  "tick": {"type": "integer"},
  "mode": {"type": "integer", "description": "safety::Mode"},
  "gait_phase": {"type": "integer", "description": "0 none, 1 start, 2 transition, 3 finalisation"},
  "gait_state": {"type": "integer", "description": "0 to 15 within the cycle"},
  "stance": {"type": "integer", "description": "foot that carries: 0 left, 1 right, 2 both"},
  "faults": {"type": "integer", "description": "safety::Fault bits"},
  "roll_rad": {"type": "number"}, "pitch_rad": {"type": "number"},
  "com_m": {"type": "array", "items": {"type": "number"}, "description": "estimated, frame odom"},
  "com_velocity_m_s": {"type": "array", "items": {"type": "number"}, "description": "likewise"},
  "dcm_m": {"type": "array", "items": {"type": "number"}, "description": "likewise, on the ground"},
  "left_foot_n": {"type": "array", "items": {"type": "number"}},
  "right_foot_n": {"type": "array", "items": {"type": "number"}}
 }
})";

namespace {

std::string forces_n(const Params& params, const std::uint16_t (&count)[kFootSensors]) {
  std::string out;
  for (const std::uint16_t each : count) {
    out += fmt::format("{}{:.4g}", out.empty() ? "" : ",",
                       static_cast<float>(each) * params.feet.newton_per_count);
  }
  return out;
}

}  // namespace

std::string control(const Params& params, const Inputs& inputs, const State& state,
                    const Outputs& outputs) {
  const Vec3 com_m = balance::com_m(state.estimator);
  const Xyz& velocity_m_s = state.estimator.com_velocity_m_s;
  const gait::Xy dcm_m = balance::dcm_m(state.estimator);
  return fmt::format(
      R"({{"tick":{},"mode":{},"gait_phase":{},"gait_state":{},"stance":{},"faults":{},"roll_rad":{:.4f},"pitch_rad":{:.4f},"com_m":[{:.5f},{:.5f},{:.5f}],"com_velocity_m_s":[{:.5f},{:.5f},{:.5f}],"dcm_m":[{:.5f},{:.5f}],"left_foot_n":[{}],"right_foot_n":[{}]}})",
      inputs.tick, outputs.mode, outputs.gait_phase, outputs.gait_state, outputs.stance,
      outputs.faults, 1e-4 * outputs.tilt_tenth_mrad[0], 1e-4 * outputs.tilt_tenth_mrad[1],
      com_m.x(), com_m.y(), com_m.z(), velocity_m_s.x, velocity_m_s.y, velocity_m_s.z, dcm_m.x,
      dcm_m.y, forces_n(params, inputs.foot_count[0]), forces_n(params, inputs.foot_count[1]));
}

}  // namespace verp::record::ros
