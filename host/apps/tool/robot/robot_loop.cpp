#include "host/apps/tool/robot/robot_loop.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {

void judge_fit(const bus::LinkFit& fit, const RunPlan& plan) {
  const std::string numbers = fmt::format(
      "{}: a read is held up for {:.1f} ms (median of {}, slowest tenth {:.1f}): {} of them and "
      "{:.1f} ms on the wire take {:.1f} of a period of {:g} ms",
      link::to_text(plan.link), 1e-3 * fit.delay.median_us, fit.delay.answered,
      1e-3 * fit.delay.p90_us, fit.reads, 1e-3 * fit.wire_us, 1e-3 * fit.needed_us(),
      1e-3 * fit.period_us);
  if (cli::interrupted())
    throw cli::ToolError(cli::kRunFailed, "verp run: interrupted; torque was never on");
  const std::string remedy = bus::remedy(fit, plan.walk.params, plan.link);
  if (!fit.fits()) throw cli::ToolError(cli::kNoDevice, numbers + "; " + remedy);
  if (!fit.fits_well()) {
    cli::complain("verp run: " + numbers + "; some deadlines will be missed: " + remedy);
  }
}

void judge_imu(const RunPlan& plan, const std::string& trouble) {
  constexpr const char* kRemedy =
      "without one there is no balance, and nobody notices a fall; --imu none walks all the same, "
      "on level ground, with balance off";
  const int id = plan.walk.params.imu.device_id;
  if (id == 0) {
    throw cli::ToolError(cli::kNoDevice,
                         fmt::format("verp run: {} names no IMU on the servo bus: {}",
                                     plan.walk.params.name, kRemedy));
  }
  if (trouble.empty()) return;
  throw cli::ToolError(cli::kNoDevice, fmt::format("{}: the IMU (device {}) {}: {}",
                                                   link::to_text(plan.link), id, trouble, kRemedy));
}

}  // namespace verp::tool
