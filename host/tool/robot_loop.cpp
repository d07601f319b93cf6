#include "host/tool/robot_loop.hpp"
#include "host/tool/exit_status.hpp"

namespace verp::tool {

ToolError not_up(const app::BringUpReport& report, const std::string& place,
                 const std::string& where) {
  const std::string at = fmt::format("{}: device {} ", place, report.device_id);
  switch (report.status) {
    case app::BringUpStatus::kWrongModel:
      return ToolError(
          kNoDevice,
          fmt::format("{}is a {}, the model says {}; correct the model's type or the "
                      "servo's id (`verp bus setup`)",
                      at, bus::model_name(report.found), bus::model_name(report.expected)));
    case app::BringUpStatus::kRefused:
      return ToolError(kNoDevice, fmt::format("{}refuses {}; reboot it, or see its "
                                              "hardware error: `verp bus read --id {}`",
                                              at, where, report.device_id));
    case app::BringUpStatus::kNotVerified:
      return ToolError(kNoDevice, fmt::format("{}does not keep what is written to {}; is "
                                              "another program using this bus?",
                                              at, where));
    case app::BringUpStatus::kHardwareError:
      return ToolError(kNoDevice,
                       fmt::format("{}has a hardware error ({}) and may be limp; cure it, then "
                                   "switch the servo off and on, which clears it",
                                   at, bus::hardware_errors(report.found)));
    case app::BringUpStatus::kOccupied:
      return ToolError(kNoDevice,
                       fmt::format("{}: another controller or tool commands nodes on this bus "
                                   "(identifier 0x{:03X} was heard); end it first",
                                   place, report.address));
    case app::BringUpStatus::kNotReset:
      return ToolError(kNoDevice,
                       fmt::format("{}sent no boot-up message when it was reset (NMT), and may "
                                   "have kept what was written to it before; switch it off and on",
                                   at));
    default:
      return ToolError(kNoDevice, fmt::format("{}does not answer; check power, wiring and ids "
                                              "(`verp bus scan`, `verp bus setup`)",
                                              at));
  }
}

void judge_fit(const bus::LinkFit& fit, const RunPlan& plan) {
  const std::string numbers = fmt::format(
      "{}: a read is held up for {:.1f} ms (median of {}, slowest tenth {:.1f}): {} of them and "
      "{:.1f} ms on the wire take {:.1f} of a period of {:g} ms",
      wire::to_text(plan.link), 1e-3 * fit.delay.median_us, fit.delay.answered,
      1e-3 * fit.delay.p90_us, fit.reads, 1e-3 * fit.wire_us, 1e-3 * fit.needed_us(),
      1e-3 * fit.period_us);
  if (interrupted()) throw ToolError(kRunFailed, "verp run: interrupted; torque was never on");
  const std::string remedy = bus::remedy(fit, plan.walk.params, plan.link);
  if (!fit.fits()) throw ToolError(kNoDevice, numbers + "; " + remedy);
  if (!fit.fits_well()) {
    complain("verp run: " + numbers + "; some deadlines will be missed: " + remedy);
  }
}

void judge_imu(const RunPlan& plan, const std::string& trouble) {
  constexpr const char* kRemedy =
      "without one there is no balance, and nobody notices a fall; --imu none walks all the same, "
      "on level ground, with balance off";
  const int id = plan.walk.params.imu.device_id;
  if (id == 0) {
    throw ToolError(kNoDevice, fmt::format("verp run: {} names no IMU on the servo bus: {}",
                                           plan.walk.params.name, kRemedy));
  }
  if (trouble.empty()) return;
  throw ToolError(kNoDevice, fmt::format("{}: the IMU (device {}) {}: {}", wire::to_text(plan.link),
                                         id, trouble, kRemedy));
}

}  // namespace verp::tool
