#include "host/author/import/speed.hpp"

#include <fmt/format.h>

#include "host/run/session/servo_speed.hpp"

namespace verp::import {
namespace {

using Sureness = Finding::Sureness;

}  // namespace

SpeedChoice choose_lift(Params params, bool of_damping) {
  SpeedChoice choice;
  session::ServoSpeed speed = session::servo_speed(params);
  if (speed.lower_lift_m > 0) {
    choice.lift_m = speed.lower_lift_m;
    choice.findings.push_back(
        {Sureness::kGuessed, "lift",
         fmt::format("{:.2g} mm instead of {:.2g}, because joint '{}' would need {:.3g} rad/s, and "
                     "its servo turns {:.3g}",
                     1000 * speed.lower_lift_m, 1000 * params.tuning.gait.lift_m,
                     speed.fastest.joint, session::needed_rad_s(speed.fastest),
                     speed.fastest.limit_rad_s),
         "do its feet clear the floor?"});
    params.tuning.gait.lift_m = static_cast<float>(speed.lower_lift_m);
    speed = session::servo_speed(params);
  }
  const bool enough = speed.most_m_s == speed.walk_m_s;
  choice.findings.push_back(
      {Sureness::kMeasured, "servo speed", session::text_of(speed),
       enough
           ? ""
           : fmt::format("are the motors so slow?{} --servos TYPE takes others",
                         of_damping ? " Their speed is the file's torque over its damping;" : "")});
  return choice;
}

}  // namespace verp::import
