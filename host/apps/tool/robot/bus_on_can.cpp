#include "host/apps/tool/robot/bus_on_can.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/bus_bench.hpp"
#include "host/apps/tool/robot/node_objects.hpp"
#include "host/apps/tool/robot/register_value.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/can/client.hpp"

namespace verp::tool {
namespace {

using dxl::controller::Type;

constexpr const char* kSilenceRemedy =
    "check power, wiring, termination and bit rate, or raise --timeout";

std::uint8_t node_of(const BusOptions& options) {
  return static_cast<std::uint8_t>(options.id);
}

using Asked = can::NodeIdentity::Asked;

can::NodeIdentity identify(can::Client& client, const BusOptions& options) {
  const auto identity = client.identify(node_of(options));
  if (identity && identity->asked == Asked::kFellSilent) {
    throw cli::ToolError(cli::kNoDevice,
                         fmt::format("{}: node {} answered, then fell silent while it was "
                                     "asked what it is; {}",
                                     client.place(), options.id, kSilenceRemedy));
  }
  if (identity) return *identity;
  throw cli::ToolError(
      cli::kNoDevice, fmt::format("{}: node {} does not answer, asked {} times; {}", client.place(),
                                  options.id, can::Client::kAttempts, kSilenceRemedy));
}

can::Client open(const BusOptions& options) {
  if (!options.object.empty()) parse_object(options.object);  // throws early
  return {link::parse_endpoint(options.link),
          static_cast<std::uint32_t>(options.timeout_ms * 1000)};
}

std::string kind_of(const can::NodeIdentity& each) {
  if (!each.name.empty()) return each.name;
  const unsigned profile = each.device_type & 0xFFFF;
  return profile == 0 ? "of no profile" : fmt::format("CiA {}", profile);
}
using Told = std::optional<std::uint32_t>;
cli::Json json_of(const Told& number) {
  return number ? cli::Json(*number) : cli::Json(nullptr);
}
std::string text_of(const Told& number) {
  return number ? fmt::format("0x{:X}", *number) : "not told";
}
const char* why_not_all(Asked asked) {
  return asked == Asked::kFellSilent ? "fell silent while it was asked" : "not asked to the end";
}
cli::Json to_json(const can::NodeIdentity& each) {
  cli::Json json = {{"id", each.node},
                    {"device_type", each.device_type},
                    {"vendor", json_of(each.vendor)},
                    {"product", json_of(each.product)},
                    {"revision", json_of(each.revision)},
                    {"name", each.name}};
  if (each.asked != Asked::kToTheEnd) json["trouble"] = why_not_all(each.asked);
  return json;
}
std::string to_text(const can::NodeIdentity& each) {
  const std::string head =
      fmt::format("{:3}  {:<24}  type 0x{:08X}  ", each.node, kind_of(each), each.device_type);
  if (each.asked != Asked::kToTheEnd) return head + why_not_all(each.asked) + "\n";
  return head + fmt::format("vendor {}  product {}\n", text_of(each.vendor), text_of(each.product));
}
void print(const std::vector<can::NodeIdentity>& found, const BusOptions& options) {
  if (options.json) {
    cli::Json nodes = cli::Json::array();
    for (const can::NodeIdentity& each : found) nodes.push_back(to_json(each));
    return cli::print_json({{"link", options.link}, {"nodes", nodes}});
  }
  for (const can::NodeIdentity& each : found) cli::answer(to_text(each));
}

}  // namespace

bool on_can(const BusOptions& options) {
  return !options.link.empty() &&
         link::parse_endpoint(options.link).kind == link::Endpoint::Kind::kCan;
}

int scan_can(const BusOptions& options) {
  can::Client client = open(options);
  cli::catch_interrupts();
  client.stop_when(cli::interrupted);
  const auto found = client.scan();
  if (found.empty() && !cli::interrupted()) {
    throw cli::ToolError(cli::kNoDevice, options.link + ": no node answers; " + kSilenceRemedy);
  }
  print(found, options);
  if (cli::interrupted()) {
    cli::complain(options.link + ": interrupted; there may be more nodes");
    return cli::kRunFailed;
  }
  const auto silent = std::count_if(found.begin(), found.end(), [](const auto& each) {
    return each.asked == Asked::kFellSilent;
  });
  if (silent == 0) return cli::kGood;
  cli::complain(
      fmt::format("{}: {} of {} nodes answered, then fell silent while they were asked; {}",
                  options.link, silent, found.size(), kSilenceRemedy));
  return cli::kNoDevice;
}

int ping_can(const BusOptions& options) {
  can::Client client = open(options);
  const can::NodeIdentity identity = identify(client, options);
  cli::print_answer(options.json, to_json(identity), to_text(identity));
  return cli::kGood;
}

int read_can(const BusOptions& options) {
  can::Client client = open(options);
  const bool all = options.names.empty() && options.object.empty();
  cli::Json values = cli::Json::object();
  for (const NodeObject& each : wanted(options, objects_of(identify(client, options)))) {
    std::vector<std::uint8_t> bytes;
    try {
      bytes = client.read(node_of(options), each.at);
    } catch (const can::SilentError&) {
      throw;
    } catch (const bus::DeviceError&) {
      if (!all) throw;  // unreadable objects are skipped
      continue;
    }
    if (options.json) {
      values[can::to_text(each.at)] = {{"name", each.name}, {"value", json_value(each, bytes)}};
    } else if (!options.object.empty()) {
      cli::answer(show_value(each, bytes) + "\n");
    } else {
      cli::answer(fmt::format("{:>7}  {:<32} {}\n", can::to_text(each.at), each.name,
                              with_unit(show_value(each, bytes), unit_of(each.at))));
    }
  }
  if (options.json) cli::print_json({{"id", options.id}, {"objects", values}});
  return cli::kGood;
}

int write_can(const BusOptions& options) {
  if (options.object.empty() && options.names.size() != 1) {
    throw cli::ToolError(cli::kBadInput,
                         "verp bus write: name one object, by --register or --object");
  }
  can::Client client = open(options);
  const auto objects = wanted(options, objects_of(identify(client, options)));
  if (objects.size() != 1) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp bus write: '{}' is an array; name one element: {}",
                                     options.names.front(), objects.front().name));
  }
  NodeObject object = objects.front();
  if (!object.writable) throw cli::ToolError(cli::kBadInput, object.name + " is read-only");
  if (!object.type) {  // only its size is known
    const std::size_t size = client.read(node_of(options), object.at).size();
    if (size == 1) object.type = Type::kU8;
    if (size == 2) object.type = Type::kU16;
    if (size == 4) object.type = Type::kU32;
    if (!object.type) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{} has {} bytes; only numbers of 1, 2 and 4 bytes "
                                       "can be written",
                                       object.name, size));
    }
  }
  const std::vector<std::uint8_t> bytes = parse_values(object.as_register(), options.values);
  client.write(node_of(options), object.at, bytes);
  if (options.json) {
    cli::print_json(
        {{"id", options.id}, {"object", can::to_text(object.at)}, {"bytes", bytes.size()}});
  }
  return cli::kGood;
}

int bench_can(const BusOptions& options) {
  can::Client client = open(options);
  identify(client, options);
  cli::catch_interrupts();
  constexpr std::uint16_t kBytes = 4;  // size of the device type
  const BusBench result =
      run_bus_bench([&] { return client.read_once(node_of(options), canopen::plan::kDeviceType); },
                    kBytes, options.seconds);
  cli::print_answer(options.json, to_json(result), to_text(result));
  if (cli::interrupted()) return cli::kRunFailed;
  if (result.good == 0)
    throw cli::ToolError(cli::kNoDevice, options.link + ": no read was answered");
  return cli::kGood;
}

}  // namespace verp::tool
