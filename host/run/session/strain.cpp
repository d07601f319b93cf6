#include "host/run/session/strain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/safety/machine.hpp"

namespace verp::session {
namespace {

constexpr std::uint32_t kPower =
    safety::kFaultVoltage | safety::kFaultTemperature | safety::kFaultServoError;

}  // namespace

void Strain::see(const sim::TwinRobot& robot, std::uint32_t faults) {
  if (!robot.fallen() && (faults & kPower) != 0) before_fall_ = true;
  const model::Entity& entity = robot.entity();
  if (entity.joints.empty()) return;
  lowest_v_ = std::min(lowest_v_, robot.supply_v());
  highest_v_ = std::max(highest_v_, robot.supply_v());
  most_v_ = sim::ServoRating{.nominal_v = entity.joints[0].servo.nominal_v}.most_v();
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    if (entity.joints[j].follows >= 0) continue;
    const double hot_c = robot.servo(static_cast<int>(j)).measurement().temperature_c;
    if (hot_c <= hottest_c_) continue;
    hottest_c_ = hot_c;
    hottest_ = j;
  }
}

bool Strain::came_before_fall(std::uint32_t faults) const {
  return before_fall_ && (faults & kPower) != 0;
}

/// A servo's error says that something is wrong, and not what: the numbers that are beyond tell.
std::string Strain::text(const Params& params, std::uint32_t faults) const {
  const SafetyTuning& safety = params.tuning.safety;
  const auto low_v = static_cast<double>(safety.voltage_low_v);
  const auto hot_c = static_cast<double>(safety.temperature_high_c);
  const bool error = (faults & safety::kFaultServoError) != 0;
  std::string out;
  const auto add = [&](const std::string& part) { out += (out.empty() ? "" : ", ") + part; };
  if ((faults & safety::kFaultVoltage) != 0 || (error && lowest_v_ < low_v))
    add(fmt::format("lowest {:.1f} V, cut-out {:.1f} V", lowest_v_, low_v));
  if (error && highest_v_ > most_v_)
    add(fmt::format("highest {:.1f} V, servos admit {:.1f} V", highest_v_, most_v_));
  if ((faults & safety::kFaultTemperature) != 0 || (error && hottest_c_ > hot_c))
    add(fmt::format("{} has {:.0f} C, limit {:.0f} C", params.joint[hottest_].name, hottest_c_,
                    hot_c));
  return out;
}

}  // namespace verp::session
