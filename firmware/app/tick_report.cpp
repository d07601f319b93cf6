#include "firmware/app/tick_report.hpp"

namespace verp::app {

TickReport::TickReport(const Params& params, RegisterImage& image)
    : params_(params), image_(image), devices_(params, image) {
  image_.set(reg("joint_beyond"), kNobody);
}

void TickReport::tick(const TickRecord& record, const State& state, const Outputs& outputs) {
  const Inputs& inputs = record.inputs;
  image_.set(reg("torque_enable"), static_cast<std::uint8_t>(outputs.torque_enable != 0));
  // A quiet operator is no hardware error.
  image_.set(
      reg("hardware_error"),
      static_cast<std::uint8_t>(outputs.faults & ~std::uint32_t{safety::kFaultOperatorQuiet}));
  image_.set(reg("digest"), record.digest.chain);
  image_.set(reg("tick"), inputs.tick);
  image_.set(reg("tick_low"), static_cast<std::uint16_t>(inputs.tick));
  image_.set(reg("inputs_flags"), inputs.flags);
  image_.set(reg("faults"), outputs.faults);
  image_.set(reg("joint_beyond"), refused_joint(inputs, outputs));
  image_.set(reg("mode"), outputs.mode);
  image_.set(reg("gait_phase"), outputs.gait_phase);
  image_.set(reg("gait_state"), outputs.gait_state);
  image_.set(reg("stance"), outputs.stance);
  image_.set(reg("tilt_roll"), outputs.tilt_tenth_mrad[0]);
  image_.set(reg("tilt_pitch"), outputs.tilt_tenth_mrad[1]);
  static_assert(reg("body_position") + sizeof(balance::Whereabouts) == reg_end("dcm"));
  image_.set(reg("body_position"), balance::whereabouts(state.estimator, state.attitude));
  image_.set(reg("gyro"), inputs.gyro_count);
  image_.set(reg("accel"), inputs.accel_count);
  image_.set(reg("feet"), inputs.foot_count);
  image_.set(reg("joints_fresh"), inputs.fresh);
  image_.set(reg("joints_torque"), outputs.torque_enable);
  image_.set(reg("command_age"), state.admit.operator_age);
  image_.set(reg("present_position"), inputs.position_count);
  image_.set(reg("goal_position"), outputs.goal_count);
  if ((inputs.flags & kOverrun) != 0) {
    image_.set(reg("overruns"), image_.get<std::uint32_t>(reg("overruns")) + 1);
  }
  if ((inputs.flags & kSlowFresh) != 0) take_telemetry(inputs);
  devices_.tick(inputs, state, outputs);
}

void TickReport::servos_gone() {
  image_.set(reg("torque_enable"), std::uint8_t{0});
  image_.set(reg("joints_torque"), std::uint32_t{0});
}

void TickReport::bring_up(const BringUpReport& report) {
  image_.set(reg("bring_up"), static_cast<std::uint8_t>(static_cast<int>(report.status) + 1));
  image_.set(reg("bring_up_device"), report.device_id);
  image_.set(reg("bring_up_register"), report.address);
}

void TickReport::imu_calibration(table::ImuCalibrationState state) {
  image_.set(reg("imu_calibration"), state);
}

void TickReport::health(const LoopHealth& health) {
  const BusCounters& bus = health.bus;
  image_.set(reg("bus_crc_errors"), health.bus_crc_errors);
  image_.set(reg("bus_timeouts"), bus.timeouts);
  image_.set(reg("bus_strays"), bus.strays);
  image_.set(reg("bus_errors"), bus.errors);
  image_.set(reg("bus_refused"), bus.refused);
  image_.set(reg("bus_noise"), health.bus_noise_bytes);
  image_.set(reg("skipped_periods"), health.skipped_periods);
  image_.set(reg("imu_faults"), health.imu_faults);
  devices_.bus_errors(health.bus_crc_errors + bus.timeouts + bus.refused);
  battery_tenth_v_ = health.battery_tenth_v;
  if (battery_tenth_v_ != 0) image_.set(reg("battery_voltage"), battery_tenth_v_);
  for (int j = 0; health.efforts != nullptr && j < params_.joint_count; ++j) {
    image_.set(element(reg("joint_velocity"), j, 4), health.efforts[j].velocity);
    image_.set(element(reg("joint_torque"), j, 2), health.efforts[j].torque);
  }
}

void TickReport::link(std::uint32_t crc_errors, const hal::LinkErrors& errors) {
  image_.set(reg("link_crc_errors"), crc_errors);
  image_.set(reg("link_overruns"), errors.overruns);
  image_.set(reg("link_framing"), errors.framing);
  image_.set(reg("link_noise"), errors.noise);
  image_.set(reg("link_losses"), errors.losses);
  devices_.link_errors(crc_errors + errors.overruns + errors.framing + errors.noise);
}

std::uint8_t TickReport::refused_joint(const Inputs& inputs, const Outputs& outputs) const {
  if ((outputs.faults & safety::kFaultJointBeyond) == 0) return kNobody;
  const int joint = safety::joint_beyond(params_, inputs.position_count);
  return joint < kMaxJoints ? params_.joint[joint].servo_id : kNobody;
}

void TickReport::take_telemetry(const Inputs& inputs) {
  const int joint = inputs.slow_joint;
  if (joint >= params_.joint_count) return;
  image_.set(element(reg("joint_temperature"), joint, 1), inputs.slow_temperature_c);
  image_.set(element(reg("joint_error"), joint, 1), inputs.slow_error);
  image_.set(element(reg("joint_voltage"), joint, 2), inputs.slow_voltage_tenth_v);
  std::uint8_t hottest_c = 0, hottest = 0;
  std::uint16_t lowest_tenth_v = 0xFFFF;
  for (int j = 0; j < params_.joint_count; ++j) {
    const auto temperature_c = image_.get<std::uint8_t>(element(reg("joint_temperature"), j, 1));
    const auto tenth_v = image_.get<std::uint16_t>(element(reg("joint_voltage"), j, 2));
    if (temperature_c > hottest_c) {
      hottest_c = temperature_c;
      hottest = params_.joint[j].servo_id;
    }
    if (tenth_v != 0 && tenth_v < lowest_tenth_v) lowest_tenth_v = tenth_v;
  }
  image_.set(reg("hottest_servo"), hottest);
  image_.set(reg("hottest_temperature"), hottest_c);
  if (battery_tenth_v_ == 0 && lowest_tenth_v != 0xFFFF) {
    image_.set(reg("battery_voltage"), lowest_tenth_v);
  }
}

}  // namespace verp::app
