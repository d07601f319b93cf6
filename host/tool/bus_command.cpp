#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/bus/client.hpp"
#include "host/bus/register_names.hpp"
#include "host/eds/eds.hpp"
#include "host/tool/bus_bench.hpp"
#include "host/tool/bus_on_can.hpp"
#include "host/tool/bus_options.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/json.hpp"
#include "host/tool/register_value.hpp"
#include "host/tool/setup_command.hpp"
#include "host/tool/suggest.hpp"

namespace verp::tool {
namespace {

bus::Client open(const BusOptions& options) {
  if (!options.object.empty()) {
    throw ToolError(kBadInput,
                    "--object is of CAN's nodes (--link can:...); devices on other links "
                    "have --register or --address");
  }
  return {wire::parse_endpoint(options.link),
          static_cast<std::uint32_t>(options.timeout_ms * 1000)};
}

/// What the answer does not show: that it took more than one try.
void tell_tries(const bus::Client& client, const BusOptions& options, Json* json) {
  if (client.tries() <= 1) return;
  if (json != nullptr) {
    (*json)["tries"] = client.tries();
  } else {
    complain(
        fmt::format("{}: an answer took {} tries: the link is late or loses bytes; raise "
                    "--timeout, or see `verp bus bench`",
                    options.link, client.tries()));
  }
}

[[noreturn]] void nobody(const std::string& what) {
  throw ToolError(kNoDevice, what + "; check power, wiring and baud rate, or raise --timeout");
}

bus::Identity identify(bus::Client& client, const BusOptions& options) {
  const auto identity = client.ping(static_cast<std::uint8_t>(options.id));
  if (!identity) {
    nobody(fmt::format("{}: device {} does not answer, asked {} times", options.link, options.id,
                       bus::Client::kAttempts));
  }
  return *identity;
}

Json to_json(const bus::Identity& each) {
  return {{"id", each.id},
          {"model", each.model},
          {"name", bus::model_name(each.model)},
          {"firmware", each.firmware}};
}

void print(const std::vector<bus::Identity>& found, const BusOptions& options) {
  if (options.json) {
    Json devices = Json::array();
    for (const bus::Identity& each : found) devices.push_back(to_json(each));
    return print_json({{"link", options.link}, {"devices", devices}});
  }
  for (const bus::Identity& each : found) {
    answer(fmt::format("{:3}  {:<12}  firmware {}\n", each.id, bus::model_name(each.model),
                       each.firmware));
  }
}

int scan(const BusOptions& options) {
  bus::Client client = open(options);
  std::vector<bus::Identity> found;
  if (options.each) {
    for (int id = 0; id <= dxl::kMaxId; ++id) {
      const auto one = client.ping(static_cast<std::uint8_t>(id), 1);
      if (one) found.push_back(*one);
    }
  } else {
    found = client.scan();
  }
  if (client.crc_errors() > 0) {
    complain(
        fmt::format("{}: {} damaged packets: devices may be missing or share an id; "
                    "`--each` asks one id at a time",
                    options.link, client.crc_errors()));
  }
  if (found.empty()) nobody(options.link + ": no device answers");
  print(found, options);
  return kGood;
}

int ping(const BusOptions& options) {
  bus::Client client = open(options);
  const bus::Identity identity = identify(client, options);
  if (options.json) {
    Json json = to_json(identity);
    tell_tries(client, options, &json);
    print_json(json);
  } else {
    print({identity}, options);
    tell_tries(client, options, nullptr);
  }
  return kGood;
}

bus::NamedRegister by_name(const bus::Identity& identity, const std::string& name) {
  const bus::NamedRegister* found = bus::find_register(identity.model, name);
  if (found != nullptr) return *found;
  std::vector<std::string> names;
  for (const bus::NamedRegister& each : bus::registers_of(identity.model)) {
    names.emplace_back(each.name);
  }
  throw ToolError(kBadInput,
                  fmt::format("{} has no register '{}'{}; give --address and --size",
                              bus::model_name(identity.model), name, did_you_mean(name, names)));
}

bus::NamedRegister by_address(const BusOptions& options) {
  using dxl::controller::Type;
  const Type type = options.size == 1 ? Type::kU8 : options.size == 2 ? Type::kU16 : Type::kU32;
  return {.address = static_cast<std::uint16_t>(options.address),
          .name = "--address",
          .type = type,
          .access = dxl::controller::Access::kWrite};
}

std::vector<bus::NamedRegister> wanted(bus::Client& client, const BusOptions& options) {
  if (options.address >= 0) return {by_address(options)};
  const bus::Identity identity = identify(client, options);
  std::vector<bus::NamedRegister> all;
  for (const std::string& name : options.names) all.push_back(by_name(identity, name));
  if (!all.empty()) return all;
  const auto known = bus::registers_of(identity.model);
  if (known.empty()) {
    throw ToolError(kBadInput, fmt::format("{}: its registers have no names here; give --address "
                                           "and --size",
                                           bus::model_name(identity.model)));
  }
  return {known.begin(), known.end()};
}

int read(const BusOptions& options) {
  bus::Client client = open(options);
  const auto id = static_cast<std::uint8_t>(options.id);
  Json values = Json::object();
  for (const bus::NamedRegister& each : wanted(client, options)) {
    const auto bytes = client.read(id, each.address, static_cast<std::uint16_t>(each.bytes()));
    if (options.json) {
      values[options.address >= 0 ? std::to_string(each.address) : each.name] =
          json_value(each, bytes);
    } else if (options.address >= 0) {
      answer(show_value(each, bytes) + "\n");
    } else {
      answer(fmt::format("{:4}  {:<24} {} {}\n", each.address, each.name, show_value(each, bytes),
                         each.unit));
    }
  }
  Json json = {{"id", id}, {"registers", values}};
  tell_tries(client, options, options.json ? &json : nullptr);
  if (options.json) print_json(json);
  return kGood;
}

int write(const BusOptions& options) {
  if (options.address < 0 && options.names.size() != 1) {
    throw ToolError(kBadInput, "verp bus write: name one register, by --register or --address");
  }
  bus::Client client = open(options);
  const bus::NamedRegister reg = wanted(client, options).front();
  if (!reg.writable()) {
    throw ToolError(kBadInput, fmt::format("{} is read-only", reg.name));
  }
  const auto id = static_cast<std::uint8_t>(options.id);
  const std::vector<std::uint8_t> bytes = parse_values(reg, options.values);
  client.write(id, reg.address, bytes);
  Json json = {{"id", id}, {"address", reg.address}, {"bytes", bytes.size()}};
  tell_tries(client, options, options.json ? &json : nullptr);
  if (options.json) print_json(json);
  return kGood;
}

int bench(const BusOptions& options) {
  bus::Client client = open(options);
  identify(client, options);
  const auto id = static_cast<std::uint8_t>(options.id);
  const auto address = static_cast<std::uint16_t>(options.bench_address);
  const auto size = static_cast<std::uint16_t>(options.size);
  client.read(id, address, size);  // says so if there is nothing to be read
  catch_interrupts();
  const BusBench result = run_bus_bench(client, id, address, size, options.seconds);
  if (options.json) {
    print_json(to_json(result));
  } else {
    answer(to_text(result));
  }
  const wire::Endpoint endpoint = wire::parse_endpoint(options.link);
  if (endpoint.kind == wire::Endpoint::Kind::kSerial) advise_latency(endpoint.place);
  if (interrupted()) return kRunFailed;
  if (result.good == 0) nobody(options.link + ": no read was answered");
  return kGood;
}

CLI::App* add(CLI::App* bus, const std::shared_ptr<BusOptions>& options, const char* name,
              const char* description) {
  CLI::App* app = bus->add_subcommand(name, description);
  app->add_option("--link", options->link,
                  "serial:/dev/ttyUSB0@1000000, pty:PATH, tcp:HOST:PORT, unix:PATH, can:can0")
      ->required();
  app->add_option("--timeout", options->timeout_ms, "what an answer may take, ms")
      ->transform(number_between(1, 10000, "ms"))
      ->capture_default_str();
  add_json_flag(*app, options->json);
  return app;
}

void add_id(CLI::App* app, const std::shared_ptr<BusOptions>& options) {
  app->add_option("--id", options->id,
                  fmt::format("the device, on CAN the node [the controller: {}, on CAN {}]",
                              dxl::controller::kDefaultId, canopen::plan::kControllerNode));
}

/// Which ids there are depends on the link.
void check_id(const BusOptions& options, bool can) {
  if (can && !canopen::is_node(static_cast<unsigned>(options.id))) {
    throw ToolError(kBadInput, fmt::format("--id: {} is no node id of CANopen; give 1 to {}",
                                           options.id, canopen::kMaxNode));
  }
  if (!can && (options.id < 0 || options.id > dxl::kMaxId)) {
    throw ToolError(kBadInput, fmt::format("--id: {} is out of range; give 0 to {}", options.id,
                                           int{dxl::kMaxId}));
  }
}

void add_registers(CLI::App* app, const std::shared_ptr<BusOptions>& options, const char* help) {
  CLI::Option* name = app->add_option("--register", options->names, help)->allow_extra_args(false);
  app->add_option("--address", options->address, "where, for devices without names")
      ->check(CLI::Range(0, 0xFFFF))
      ->excludes(name);
  app->add_option("--size", options->size, "bytes at --address")
      ->check(CLI::IsMember({1, 2, 4}))
      ->capture_default_str();
  app->add_option("--object", options->object, "on CAN: INDEX:SUBINDEX, such as 6064:0")
      ->excludes(name);
}

/// Words that mean something on serial links only, and what is to be done on CAN.
void refuse_on_can(const std::vector<CLI::App*>& commands) {
  constexpr struct {
    const char *word, *instead;
  } kSerial[] = {{"--each", "on CAN every id is asked anyway"},
                 {"--address", "on CAN give --object INDEX:SUBINDEX, such as 6064:0"},
                 {"--size", "on CAN each object knows its own"}};
  for (const CLI::App* each : commands) {
    for (const auto& [word, instead] : kSerial) {
      const CLI::Option* option = each->get_option_no_throw(word);
      if (option == nullptr || option->count() == 0) continue;
      throw ToolError(kBadInput,
                      fmt::format("{} is of devices on serial links; {}", word, instead));
    }
  }
}

}  // namespace

Subcommand add_bus(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "bus", "Dynamixel devices and CANopen nodes: find them, read, write, measure");
  app->require_subcommand(1);
  auto options = std::make_shared<BusOptions>();
  CLI::App* find = add(app, options, "scan", "every device that answers");
  find->add_flag("--each", options->each, "ask id after id: slow, and finds more on a bad bus");
  CLI::App* call = add(app, options, "ping", "whether one device is there, and what it is");
  CLI::App* show = add(app, options, "read", "registers; all of them if none is named");
  CLI::App* put = add(app, options, "write", "one register");
  CLI::App* measure = add(app, options, "bench", "round trips a second, and how long they take");
  for (CLI::App* each : {call, show, put, measure}) add_id(each, options);
  add_registers(show, options, "by name; may be repeated");
  add_registers(put, options, "by name");
  put->add_option("VALUE", options->values, "whole numbers, or 0x...; one for each element")
      ->required();
  measure->add_option("--for", options->seconds, "how long, s")
      ->transform(number_between(0.1, 3600, "s"))
      ->capture_default_str();
  measure->add_option("--address", options->bench_address, "what is read; on CAN it is 1000:0")
      ->check(CLI::Range(0, 0xFFFF))
      ->capture_default_str();
  measure->add_option("--size", options->size, "bytes of it")
      ->check(CLI::Range(1, 400))
      ->capture_default_str();
  const Subcommand setup = add_bus_setup(*app);
  const Subcommand checklist = add_bus_checklist(*app);
  const Subcommand load = add_bus_load(*app);
  CLI::App* list = app->add_subcommand("registers", "the controller's registers, as a page");
  CLI::App* sheet = app->add_subcommand("eds", "a node's electronic data sheet, for CANopen tools");
  std::vector<std::string> nodes;
  for (const eds::Sheet& each : eds::sheets()) nodes.emplace_back(each.node);
  sheet->add_option("node", options->node, "of which node")
      ->required()
      ->check(CLI::IsMember(nodes));
  return {app, [=] {
            const bool can = on_can(*options);
            if (can) refuse_on_can({find, show, put, measure});
            bool named = false;  // the device
            for (const CLI::App* each : {call, show, put, measure}) {
              named = named || each->get_option("--id")->count() > 0;
            }
            if (!named) {
              options->id = can ? canopen::plan::kControllerNode : dxl::controller::kDefaultId;
            }
            check_id(*options, can);
            if (find->parsed()) return can ? scan_can(*options) : scan(*options);
            if (call->parsed()) return can ? ping_can(*options) : ping(*options);
            if (show->parsed()) return can ? read_can(*options) : read(*options);
            if (put->parsed()) return can ? write_can(*options) : write(*options);
            if (measure->parsed()) return can ? bench_can(*options) : bench(*options);
            for (const Subcommand& each : {setup, checklist, load}) {
              if (each.app->parsed()) return each.run();
            }
            if (list->parsed()) answer(bus::controller_document());
            for (const eds::Sheet& each : eds::sheets()) {
              if (sheet->parsed() && options->node == each.node) {
                answer(eds::to_text(each.describe()));
              }
            }
            return int{kGood};
          }};
}

}  // namespace verp::tool
