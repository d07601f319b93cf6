#include "host/run/session/not_up.hpp"

#include <fmt/format.h>

#include "host/twin/bus/register_names.hpp"

namespace verp::session {

NotUp not_up(const app::BringUpReport& report, const std::string& place, const std::string& where) {
  const std::string at = fmt::format("{}: device {} ", place, report.device_id);
  switch (report.status) {
    case app::BringUpStatus::kWrongModel:
      return NotUp(
          fmt::format("{}is a {}, the model says {}; correct the model's type or the "
                      "servo's id (`verp bus setup`)",
                      at, bus::model_name(report.found), bus::model_name(report.expected)));
    case app::BringUpStatus::kRefused:
      return NotUp(
          fmt::format("{}refuses {}; reboot it, or see its "
                      "hardware error: `verp bus read --id {}`",
                      at, where, report.device_id));
    case app::BringUpStatus::kNotVerified:
      return NotUp(
          fmt::format("{}does not keep what is written to {}; is "
                      "another program using this bus?",
                      at, where));
    case app::BringUpStatus::kHardwareError:
      return NotUp(
          fmt::format("{}has a hardware error ({}) and may be limp; cure it, then "
                      "switch the servo off and on, which clears it",
                      at, bus::hardware_errors(report.found)));
    case app::BringUpStatus::kOccupied:
      return NotUp(
          fmt::format("{}: another controller or tool commands nodes on this bus "
                      "(identifier 0x{:03X} was heard); end it first",
                      place, report.address));
    case app::BringUpStatus::kNotReset:
      return NotUp(
          fmt::format("{}sent no boot-up message when it was reset (NMT), and may "
                      "have kept what was written to it before; switch it off and on",
                      at));
    default:
      return NotUp(
          fmt::format("{}does not answer; check power, wiring and ids "
                      "(`verp bus scan`, `verp bus setup`)",
                      at));
  }
}

}  // namespace verp::session
