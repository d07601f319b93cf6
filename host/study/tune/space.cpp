#include "host/study/tune/space.hpp"

#include <algorithm>
#include <cmath>

#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tune {
namespace {

int id_of(const char* name) {
  return model::tuning_id(name).value();
}

void let_steps_be(Tuning& tuning, double speed_m_s) {
  constexpr double kRoom = 1.2;
  const double step_m = kRoom * 0.5 * speed_m_s * static_cast<double>(tuning.gait.cycle_s);
  const int id = id_of("gait.max_step_m");
  const float needed = std::min(static_cast<float>(step_m), kTuningRanges[id].high);
  tuning.gait.max_step_m = std::max(tuning.gait.max_step_m, needed);
}

}  // namespace

// Lengths scale with the hip's height, times with its root, as in a pendulum. Steps are those for
// generic21 (0.147 m).
Space::Space(const Params& params) : start_(params.tuning) {
  constexpr double kHip_m = 0.147;
  const double size = static_cast<double>(start_.gait.hip_height_m) / kHip_m;
  const double time = std::sqrt(size);
  axes_ = {{id_of("gait.cycle_s"), 0.04 * time},
           {id_of("gait.lift_m"), 0.004 * size},
           {id_of("gait.half_stance_m"), 0.003 * size},
           {id_of("gait.hip_height_m"), 0.004 * size},
           {id_of("gait.trunk_pitch_rad"), 0.03},
           {id_of("gait.zmp_x_m"), 0.003 * size},
           {id_of("gait.zmp_y_m"), 0.003 * size},
           {id_of("gait.touchdown_m"), 0.0015 * size},
           {id_of("gait.look_ahead_s"), 0.005},
           {id_of("balance.inertia_share"), 0.2},
           {id_of("balance.friction_share"), 0.3},
           {id_of("balance.ankle_pitch_tilt"), 0.15},
           {id_of("balance.ankle_pitch_rate_s"), 0.012 * time},
           {id_of("balance.ankle_roll_tilt"), 0.15},
           {id_of("balance.ankle_roll_rate_s"), 0.012 * time},
           {id_of("balance.hip_pitch_tilt"), 0.15},
           {id_of("balance.hip_pitch_rate_s"), 0.012 * time},
           {id_of("balance.hip_roll_tilt"), 0.15},
           {id_of("balance.hip_roll_rate_s"), 0.012 * time},
           {id_of("balance.swing_level"), 0.2}};
}

Eigen::VectorXd Space::at(const Tuning& tuning) const {
  Eigen::VectorXd at(size());
  for (Eigen::Index i = 0; i < size(); ++i) {
    const Axis& axis = axes_[static_cast<std::size_t>(i)];
    at[i] = (static_cast<double>(tuning_value(tuning, axis.id)) -
             static_cast<double>(tuning_value(start_, axis.id))) /
            axis.step;
  }
  return at;
}

Tuning Space::tuning(const Eigen::VectorXd& at, double speed_m_s) const {
  Tuning tuning = start_;
  for (Eigen::Index i = 0; i < size(); ++i) {
    const Axis& axis = axes_[static_cast<std::size_t>(i)];
    if (at[i] == 0) continue;
    const auto value =
        static_cast<float>(static_cast<double>(tuning_value(start_, axis.id)) + at[i] * axis.step);
    const Range& range = kTuningRanges[axis.id];
    set_tuning_value(tuning, axis.id, std::clamp(value, range.low, range.high));
  }
  let_steps_be(tuning, speed_m_s);
  return tuning;
}

std::vector<Tuning> Space::first_look(double speed_m_s) const {
  std::vector<Tuning> looks;
  const Range& cycles = kTuningRanges[id_of("gait.cycle_s")];
  for (const float height : {1.0F, 0.95F}) {
    for (const float cycle : {1.0F, 0.8F, 0.9F, 1.15F, 1.35F}) {
      Tuning tuning = start_;
      tuning.gait.hip_height_m *= height;
      tuning.gait.cycle_s = std::clamp(tuning.gait.cycle_s * cycle, cycles.low, cycles.high);
      let_steps_be(tuning, speed_m_s);
      looks.push_back(tuning);
    }
  }
  return looks;
}

}  // namespace verp::tune
