#include "host/apps/tool/robot/doctor_bus.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/controller_table.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::tool {
namespace {

constexpr double kTimeout_ms = 60;  // 16 ms of an adapter, twice, with margin

/// Servos of a limb in the order of the cable, from the body out.
std::vector<int> chain(const model::Entity& robot, const model::Limb& limb) {
  std::vector<int> ids;
  for (const int j : limb.joints) {
    const model::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
    if (joint.follows < 0) ids.push_back(joint.servo.id);
  }
  return ids;
}

/// Those at the end of `ids` that are silent.
std::size_t silent_end(const std::vector<int>& ids, const std::set<int>& silent) {
  std::size_t count = 0;
  while (count < ids.size() && silent.contains(ids[ids.size() - 1 - count])) ++count;
  return count;
}

BusCase case_of(const std::string& link, const std::string& model, const std::string& bus,
                const std::string& protocol, double timeout_ms) {
  BusCase made{.link = link,
               .endpoint = link::parse_endpoint(link),
               .timeout_us = static_cast<std::uint32_t>(1000 * timeout_ms),
               .model = model,
               .bus = bus};
  if (protocol == "feetech") made.protocol = BusProtocol::kFeetech;
  if (model.empty()) return made;
  const bool can = made.endpoint.kind == link::Endpoint::Kind::kCan;
  const std::string file = model::find_model(model);
  made.robot = can ? model::load_robot_on_can(file, bus) : model::load_robot(file, bus);
  made.params = model::make_params(*made.robot);
  made.protocol = made.robot->protocol;
  if (can == (made.robot->protocol == BusProtocol::kCia402)) return made;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp bus doctor: bus '{}' of {} is not of the kind of {}; name "
                                   "another with --bus, or another --link",
                                   made.robot->bus, made.robot->name, link));
}

}  // namespace

std::set<int> devices_of(const BusCase& bus) {
  std::set<int> ids;
  if (!bus.robot) return ids;
  for (const model::Joint& each : bus.robot->joints) ids.insert(each.servo.id);
  if (bus.robot->imu) ids.insert(bus.robot->imu->id);
  ids.insert(bus.robot->feet.id.begin(), bus.robot->feet.id.end());
  ids.erase(0);  // no device on the bus
  return ids;
}

std::string BusCase::name_of(int id) const {
  if (robot) {
    for (const model::Joint& each : robot->joints) {
      if (each.follows < 0 && each.servo.id == id) return fmt::format("{} (id {})", each.name, id);
    }
    if (robot->imu && robot->imu->id == id) return fmt::format("the IMU (id {})", id);
    if (robot->feet.id[0] == id || robot->feet.id[1] == id) {
      return fmt::format("a foot sensor (id {})", id);
    }
  }
  return fmt::format("id {}", id);
}

std::string BusCase::set_up(int id, bool wired) const {
  using Kind = link::Endpoint::Kind;
  if (endpoint.kind == Kind::kCan) return "give it its settings with its maker's tool";
  std::string command =
      fmt::format("verp bus setup {} --link {}", model.empty() ? "ROBOT" : model,
                  endpoint.kind == Kind::kSerial ? "serial:" + endpoint.place : link);
  if (!bus.empty()) command += " --bus " + bus;
  if (robot) {
    for (const model::Joint& each : robot->joints) {
      if (each.follows < 0 && each.servo.id == id) command += " --joint " + each.name;
    }
  }
  return command + (wired ? " --wired" : "");
}

void judge_missing(const BusCase& bus, const std::set<int>& present, Findings& found) {
  std::set<int> silent = devices_of(bus);
  const std::size_t all = silent.size();
  for (const int each : present) silent.erase(each);
  if (silent.size() == all) {
    return found.bad("devices", fmt::format("none of the {} devices of {} answers", all, bus.model),
                     "is it another robot? `verp bus scan` shows who is there");
  }
  for (const model::Limb& limb : bus.robot->limbs) {
    const std::vector<int> ids = chain(*bus.robot, limb);
    const std::size_t count = silent_end(ids, silent), first = ids.size() - count;
    if (count == 0) continue;
    const std::string before = first == 0 ? "the controller" : bus.name_of(ids[first - 1]);
    const std::string next = bus.name_of(ids[first]);
    found.bad(limb.name,
              count == 1
                  ? fmt::format("{}, the last one, does not answer", next)
                  : fmt::format("{} and all behind it do not answer ({} devices)", next, count),
              fmt::format("check the cable between {} and {}", before, next) +
                  (count == 1 ? "; if it is good: " + bus.set_up(ids[first], false) : ""));
    for (std::size_t i = first; i < ids.size(); ++i) silent.erase(ids[i]);
  }
  for (const int each : silent) {
    found.bad(fmt::format("id {}", each),
              bus.name_of(each) + " does not answer, and others on its cable do",
              "see that it has power; it may have another id or rate: " + bus.set_up(each, false));
  }
}

void judge_strangers(const BusCase& bus, const std::set<int>& present, Findings& found) {
  const std::set<int> known = devices_of(bus);
  for (const int each : present) {
    if (known.empty() || known.contains(each)) continue;
    if (each == dxl::controller::kDefaultId || each == canopen::plan::kControllerNode) continue;
    found.advise(fmt::format("id {}", each),
                 fmt::format("a device answers, and {} has none of that id", bus.model),
                 bus.set_up(each, false));
  }
}

cli::Subcommand add_bus_doctor(CLI::App& bus) {
  CLI::App* app = bus.add_subcommand(
      "doctor", "why servos are silent or answer garbage, and how to mend it; writes nothing");
  struct Words {
    std::string link, model, bus, protocol;
    double timeout_ms = kTimeout_ms;
    bool json = false;
  };
  auto words = std::make_shared<Words>();
  cli::add_model(*app, words->model);
  cli::add_bus_option(*app, words->bus);
  app->add_option("--link", words->link,
                  "serial:/dev/ttyUSB0@1000000, tcp:HOST:PORT, unix:PATH, can:can0")
      ->required();
  app->add_option("--protocol", words->protocol, "of a serial link without MODEL")
      ->check(CLI::IsMember({"dynamixel2", "feetech"}));
  app->add_option("--timeout", words->timeout_ms, "what an answer may take, ms")
      ->transform(cli::number_between(1, 10000, "ms"))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] {
            const BusCase examined =
                case_of(words->link, words->model, words->bus, words->protocol, words->timeout_ms);
            Findings found;
            const bool can = examined.endpoint.kind == link::Endpoint::Kind::kCan;
            (can ? examine_can_bus : examine_serial_bus)(Machine(), examined, found);
            cli::print_answer(words->json, found.json(), found.text());
            return int{found.any_bad() ? cli::kNoDevice : cli::kGood};
          }};
}

}  // namespace verp::tool
