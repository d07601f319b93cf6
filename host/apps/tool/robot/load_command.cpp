#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "common/protocol/canopen/robot_load.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"
#include "host/twin/can/load_table.hpp"

namespace verp::tool {
namespace {

struct LoadWords {
  std::string robot = "generic21", bus;
  std::uint32_t data_baud = 5'000'000;  ///< highest rate of most FD transceivers
  bool json = false;
};

/// The named bus, or else the robot's first CAN bus.
model::Entity robot_on_can(const LoadWords& words) {
  model::Entity entity = model::load_robot_on_can(model::find_model(words.robot), words.bus);
  if (entity.protocol == BusProtocol::kCia402) return entity;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp bus load: {}: {} has no CAN bus{}; add <verp:bus name=\"can\" "
                  "protocol=\"cia402\"> with its drives, or name another with --bus",
                  entity.file, entity.name, words.bus.empty() ? "" : " named '" + words.bus + "'"));
}

std::string percent(std::uint32_t permille) {
  return fmt::format("{:.1f} %", permille / 10.0);
}

/// Why the configuration of a row is impossible; empty: it is possible.
std::string refusal(const Params& params, const can::LoadRow& row) {
  namespace plan = canopen::plan;
  if (!row.no_room) return "";
  const JointParams& first = params.joint[*row.no_room];
  const std::string why = row.worst_permille > plan::kMostLoadPermille
                              ? fmt::format("over {} % at worst", plan::kMostLoadPermille / 10)
                              : "over a period when all states change";
  return fmt::format("{} (node {}) and those after it do not fit: {}", first.name, first.servo_id,
                     why);
}

/// Judges the robot as its file describes it; empty: its bus has room.
std::string refusal(const model::Entity& entity, const Params& params) {
  try {
    model::require_bus(entity, params);
  } catch (const model::LoadError& error) {
    return error.what();
  }
  return "";
}

std::string table_text(const Params& params, const LoadWords& words,
                       const std::vector<can::LoadRow>& rows) {
  std::string text =
      fmt::format("{}: {} drives on CAN at {} bit/s; FD frames at {} bit/s from the data on\n",
                  params.name, params.servo_count(), params.baud, words.data_baud);
  text += fmt::format("{:>5} {:>6} {:<8} {:>12} {:>9} {:>15} {:>17} {:>16}\n", "Hz", "buses",
                      "frames", "no stuffing", "expected", "worst stuffing", "all states change",
                      "with live check");
  for (const can::LoadRow& row : rows) {
    const std::string why = refusal(params, row);
    text += fmt::format("{:>5} {:>6} {:<8} {:>12} {:>9} {:>15} {:>17} {:>16}{}\n", row.rate_hz,
                        row.buses, row.fd ? "FD" : "classic", percent(row.bare_permille),
                        percent(row.expected_permille), percent(row.worst_permille),
                        percent(row.change_permille), percent(row.published_permille),
                        why.empty() ? "" : "  refused: " + why);
  }
  return text +
         "FD frames and two buses are arithmetic: no controller here has them yet. Expected: as "
         "many stuff\nbits as random bits take. The two columns at the right are with worst "
         "stuffing.\n";
}

cli::Json table_json(const Params& params, const LoadWords& words,
                     const std::vector<can::LoadRow>& rows, const std::string& refused) {
  cli::Json json = {{"robot", params.name},         {"drives", params.servo_count()},
                    {"baud", params.baud},          {"period_us", params.period_us},
                    {"admitted", refused.empty()},  {"refusal", refused},
                    {"data_baud", words.data_baud}, {"rows", cli::Json::array()}};
  for (const can::LoadRow& row : rows) {
    const std::string why = refusal(params, row);
    json["rows"].push_back({{"rate_hz", row.rate_hz},
                            {"buses", row.buses},
                            {"fd", row.fd},
                            {"bits_without_stuffing", row.bits_bare},
                            {"bits_expected", row.bits_expected},
                            {"bits_with_worst_stuffing", row.bits_worst},
                            {"share_without_stuffing", row.bare_permille / 1000.0},
                            {"share_expected", row.expected_permille / 1000.0},
                            {"share_with_worst_stuffing", row.worst_permille / 1000.0},
                            {"share_when_all_states_change", row.change_permille / 1000.0},
                            {"share_with_live_check", row.published_permille / 1000.0},
                            {"admitted", why.empty()},
                            {"refusal", why}});
  }
  return json;
}

}  // namespace

cli::Subcommand add_bus_load(CLI::App& bus) {
  CLI::App* app =
      bus.add_subcommand("load", "what a robot's CAN bus has to carry, and what does not fit");
  auto words = std::make_shared<LoadWords>();
  cli::add_model(*app, words->robot)->capture_default_str();
  app->add_option("--bus", words->bus, "name of its bus (default: its first on CAN)");
  app->add_option("--data-baud", words->data_baud, "data rate of FD frames, bit/s")
      ->check(cli::whole_number_between(1'000'000, 8'000'000))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            const model::Entity entity = robot_on_can(*words);
            const Params params = model::make_params(entity);
            const std::string refused = refusal(entity, params);
            const std::vector<can::LoadRow> rows = can::load_table(params, words->data_baud);
            cli::print_answer(words->json, table_json(params, *words, rows, refused),
                              table_text(params, *words, rows));
            if (refused.empty()) return int{cli::kGood};
            cli::complain(refused);
            return int{cli::kBadInput};
          }};
}

}  // namespace verp::tool
