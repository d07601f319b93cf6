#include "host/apps/tool/robot/run_params.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host/apps/cli/command.hpp"
#include "host/robot/model/servo_types.hpp"

namespace verp::tool {
namespace {

// A profile of one period follows the new period: such a servo joins goals by straight lines.
void set_period(Params& params, double period_ms) {
  const std::uint32_t before_us = params.period_us;
  params.period_us = static_cast<std::uint32_t>(std::lround(1000 * period_ms));
  for (ServoProfile& servo : params.servo) {
    if (servo.profile_ms * 1000u != before_us) continue;
    servo.profile_ms = static_cast<std::uint16_t>(std::lround(period_ms));
  }
}

/// Removes the IMU and its feedback. The trace records these Params.
void do_without_imu(Params& params) {
  params.imu.device_id = 0;
  params.tuning.balance.feedback_enable = 0;
  params.tuning.balance.zeros_enable = 0;
  params.tuning.gait.heading_gain = 0;
}

/// The controller's own chip, in its scale; its mounting is the file's, unless `place` has one.
void take_own_imu(const imu::ImuPlace& place, Params& params) {
  const model::ImuType& type = *model::find_imu_type(imu::name_of(place.chip));
  params.imu.device_id = 0;
  params.imu.gyro_rad_s_per_count = static_cast<float>(type.gyro_rad_s_per_count);
  params.imu.accel_m_s2_per_count = static_cast<float>(type.accel_m_s2_per_count);
  if (place.body_imu) std::ranges::copy(*place.body_imu, params.imu.body_imu);
}

}  // namespace

std::optional<imu::ImuPlace> RunParams::own_imu() const {
  if (imu == "bus" || imu == "none") return std::nullopt;
  return imu::parse_imu(imu);
}

void declare_run_params(CLI::App& app, RunParams& words) {
  app.add_option("--imu", words.imu,
                 "bus: the model's IMU device; none: balance off, upright assumed; a chip at this "
                 "PC: i2c:/dev/i2c-1,CHIP[,address=0x29] or serial:/dev/ttyUSB0,bno055, and "
                 "[,mount=-y:x:z] if its axes point elsewhere than the model says")
      ->capture_default_str();
  app.add_option("--period", words.period_ms, "control period instead of the model's, ms")
      ->check(cli::number_between(4, 20, "ms"));
}

void apply_run_params(const RunParams& words, Params& params) {
  if (words.period_ms > 0) set_period(params, words.period_ms);
  if (!words.has_imu()) do_without_imu(params);
  if (const auto place = words.own_imu()) take_own_imu(*place, params);
}

}  // namespace verp::tool
