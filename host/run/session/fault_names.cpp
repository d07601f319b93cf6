#include "host/run/session/fault_names.hpp"

#include <bit>
#include <utility>

#include "common/safety/machine.hpp"

namespace verp::session {
namespace {

constexpr FaultName kNames[] = {
    {safety::kFaultFall, "fall"},
    {safety::kFaultEmergency, "emergency stop"},
    {safety::kFaultServoSilent, "servo silent"},
    {safety::kFaultImuSilent, "IMU silent"},
    {safety::kFaultOperatorQuiet, "operator silent"},
    {safety::kFaultTemperature, "servo too hot"},
    {safety::kFaultVoltage, "voltage low"},
    {safety::kFaultServoError, "servo hardware error"},
    {safety::kFaultJointBeyond, "joint beyond its limits"},
    {safety::kFaultFlutter, "silent again and again"},
    {safety::kFaultNotFollowing, "joint does not follow"},
    {safety::kFaultUnloaded, "feet carry nothing"},
    {safety::kNoteOverrun, "tick overran"},
    {safety::kNoteParameter, "parameter refused"},
    {safety::kNoteStrideLimited, "stride limited"},
    {safety::kNotePlanShortened, "steps shortened"},
    {safety::kNotePlanRefused, "plan refused"},
    {safety::kNoteLegLimited, "leg out of reach"},
    {safety::kNoteSpeedLimited, "joint speed limited"},
};

}  // namespace

std::span<const FaultName> all_fault_names() {
  return kNames;
}

std::string fault_names(std::uint32_t faults) {
  std::string text;
  for (const auto& [bit, name] : kNames) {
    if ((faults & bit) == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(name);
  }
  return text;
}

std::string why_it_let_go(std::uint32_t faults) {
  std::string why = "the robot let go by itself: " + fault_names(faults);
  if ((faults & safety::kFaultUnloaded) != 0) {
    why += "; to walk in the air: --set safety.unloaded_s=3600";
  }
  return why;
}

std::string silent_device(const Params& params, const State& state) {
  const std::uint32_t silent = state.machine.silent;
  if (silent == 0) return state.admit.imu_age > 1 ? "IMU" : "the controller's own pause";
  std::string names;
  for (int j = 0; j < params.joint_count; ++j) {
    if ((silent >> j & 1U) == 0) continue;
    names += (names.empty() ? "" : ", ") + std::to_string(params.joint[j].servo_id);
  }
  return (std::has_single_bit(silent) ? "servo " : "servos ") + names;
}

std::string PlanNotes::news(std::uint32_t faults) {
  const std::uint32_t notes =
      faults & (safety::kNoteStrideLimited | safety::kNotePlanShortened | safety::kNotePlanRefused);
  const std::uint32_t begun = notes & ~std::exchange(on_, notes);
  return begun == 0 ? "" : "the legs cannot do what is asked: " + fault_names(notes);
}

}  // namespace verp::session
