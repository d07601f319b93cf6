#include "host/apps/tool/robot/first_power.hpp"

#include <fmt/format.h>

#include "common/protocol/canopen/robot_plan.hpp"
#include "firmware/app/schedule.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {
namespace {

constexpr const char* kWord = "yes";

bool on_can(const Params& params) {
  return params.bus_protocol == BusProtocol::kCia402;
}

std::string joints_are_right(const Params& params) {
  if (on_can(params)) {
    return "The drives have their ids, bit rate and zeros (607Ch) by their maker's tool or "
           "switches.\n"
           "     `verp bus scan --link can:can0` shows every node, and each drive was moved "
           "alone:\n"
           "     ids, zeros and directions are right.";
  }
  return fmt::format(
      "`verp bus setup {}` has passed for every joint: ids, zeros and directions are right.",
      params.name);
}

std::string when_silent(const Params& params) {
  if (on_can(params)) {
    return fmt::format(
        "drives stop and hold after {:.2f} s without its heartbeat (1016h, 6007h).\n     They do "
        "not let go: only your switch does.",
        1e-3 * canopen::plan::patience_ms(params));
  }
  if (params.bus_protocol == BusProtocol::kFeetech) {
    return "these servos have NO bus watchdog: they hold their last goal,\n     at full strength, "
           "for "
           "ever. Only your switch lets the robot go.";
  }
  const double watchdog_s =
      1e-6 * app::bus_watchdog_units(params) * static_cast<double>(dxl::kBusWatchdogUnit_us);
  return fmt::format(
      "servos with a Bus Watchdog stop and stiffen after {:.2f} s; others keep\n     their last "
      "goal. Neither lets go: only your switch does.",
      watchdog_s);
}

}  // namespace

std::string first_power_checklist(const Params& params) {
  return fmt::format(
      "First power of {}: nobody has proven this program on your robot. Before torque is on:\n"
      "  1. The robot hangs from a strap, its soles clear of the ground; nothing is in its reach.\n"
      "     In the air, give --set safety.unloaded_s=3600: else it sits when its feet carry "
      "nothing.\n"
      "  2. A switch cuts the servos' power, within your reach, and you have tried it now.\n"
      "  3. {}\n"
      "  4. Torque is limited: give --torque 30 the first time, raise it when all moves right.\n"
      "  5. The supply gives {:g} V or more under load, and has a fuse or a current limit.\n"
      "  6. Cables have slack in every pose; no finger is near a joint.\n"
      "  7. Ctrl-C once: it sits, lies down on the floor before it (if it has the action "
      "lie_down),\n"
      "     then lets go. Ctrl-C again: it lets go at once.\n"
      "  8. If this PC falls silent, {}\n",
      params.name, joints_are_right(params),
      static_cast<double>(params.tuning.safety.voltage_low_v), when_silent(params));
}

void confirm_first_power(const Params& params, bool agreed, cli::Answers& answers) {
  cli::complain(first_power_checklist(params));
  if (agreed) return;
  const std::optional<std::string> word =
      answers.line(fmt::format("All of it is so? Type {} to switch torque on: ", kWord));
  if (word && *word == kWord) return;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp run: the checklist is not confirmed: torque stays "
                                   "off; type {} or give --yes",
                                   kWord));
}

}  // namespace verp::tool
