#include "host/apps/tool/robot/run_params.hpp"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdint>

#include "host/apps/cli/command.hpp"

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

}  // namespace

void declare_run_params(CLI::App& app, RunParams& words) {
  app.add_option("--imu", words.imu,
                 "bus: the model's IMU device; none: balance off, upright assumed")
      ->check(CLI::IsMember({"bus", "none"}))
      ->capture_default_str();
  app.add_option("--period", words.period_ms, "control period instead of the model's, ms")
      ->check(cli::number_between(4, 20, "ms"));
}

void apply_run_params(const RunParams& words, Params& params) {
  if (words.period_ms > 0) set_period(params, words.period_ms);
  if (!words.has_imu()) do_without_imu(params);
}

}  // namespace verp::tool
