#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/bus_on_can.hpp"
#include "host/apps/tool/robot/bus_on_serial.hpp"
#include "host/apps/tool/robot/bus_options.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/setup_command.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/eds/eds.hpp"

namespace verp::tool {
namespace {

CLI::App* add(CLI::App* bus, const std::shared_ptr<BusOptions>& options, const char* name,
              const char* description) {
  CLI::App* app = bus->add_subcommand(name, description);
  app->add_option("--link", options->link,
                  "serial:/dev/ttyUSB0@1000000, pty:PATH, tcp:HOST:PORT, unix:PATH, can:can0")
      ->required();
  app->add_option("--protocol", options->protocol, "of the devices on a serial link")
      ->check(CLI::IsMember({"dynamixel2", "feetech"}))
      ->capture_default_str();
  app->add_option("--timeout", options->timeout_ms, "what an answer may take, ms")
      ->transform(cli::number_between(1, 10000, "ms"))
      ->capture_default_str();
  cli::add_json_flag(*app, options->json);
  return app;
}

void add_id(CLI::App* app, const std::shared_ptr<BusOptions>& options) {
  app->add_option("--id", options->id,
                  fmt::format("the device, on CAN the node [the controller: {}, on CAN {}]",
                              dxl::controller::kDefaultId, canopen::plan::kControllerNode));
}

void check_id(const BusOptions& options, bool can) {
  if (can && !canopen::is_node(static_cast<unsigned>(options.id))) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("--id: {} is no node id of CANopen; give 1 to {}", options.id,
                                     canopen::kMaxNode));
  }
  if (!can && (options.id < 0 || options.id > dxl::kMaxId)) {
    throw cli::ToolError(cli::kBadInput, fmt::format("--id: {} is out of range; give 0 to {}",
                                                     options.id, int{dxl::kMaxId}));
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

/// Rejects options for serial links and names the alternative on CAN.
void refuse_on_can(const std::vector<CLI::App*>& commands, const CLI::App* bench) {
  constexpr struct {
    const char *word, *instead;
  } kSerial[] = {{"--protocol", "a CAN interface has nodes of CANopen"},
                 {"--each", "on CAN every id is asked anyway"},
                 {"--address", "on CAN give --object INDEX:SUBINDEX, such as 6064:0"},
                 {"--size", "on CAN each object knows its own"}};
  for (const CLI::App* each : commands) {
    for (const auto& [word, instead] : kSerial) {
      const CLI::Option* option = each->get_option_no_throw(word);
      if (option == nullptr || option->count() == 0) continue;
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{} is of devices on serial links; {}", word,
                                       each == bench ? "on CAN 1000:0 is read" : instead));
    }
  }
}

/// The usual device is our controller, which does not speak Feetech's protocol.
void require_id(const std::vector<CLI::App*>& commands) {
  for (const CLI::App* each : commands) {
    if (!each->parsed()) continue;
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp bus {}: which servo? Give --id", each->get_name()));
  }
}

}  // namespace

cli::Subcommand add_bus(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "bus");
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
      ->transform(cli::number_between(0.1, 3600, "s"))
      ->capture_default_str();
  measure->add_option("--address", options->bench_address, "what is read; on CAN it is 1000:0")
      ->check(CLI::Range(0, 0xFFFF))
      ->capture_default_str();
  measure->add_option("--size", options->size, "bytes of it")
      ->check(CLI::Range(1, 400))
      ->capture_default_str();
  const std::vector<cli::Subcommand> others = {
      add_bus_doctor(*app), add_bus_setup(*app), add_bus_checklist(*app), add_bus_load(*app),
      add_bus_wire(*app),   add_bus_laser(*app), add_bus_camera(*app),    add_bus_imu(*app)};
  CLI::App* list = app->add_subcommand("registers", "the controller's registers, as a page");
  CLI::App* sheet = app->add_subcommand("eds", "a node's electronic data sheet, for CANopen tools");
  std::vector<std::string> nodes;
  for (const eds::Sheet& each : eds::sheets()) nodes.emplace_back(each.node);
  sheet->add_option("node", options->node, "of which node")
      ->required()
      ->check(CLI::IsMember(nodes));
  return {app, [=] {
            const bool can = on_can(*options);
            if (can) refuse_on_can({find, show, put, measure}, measure);
            bool named = false;  // --id is given
            for (const CLI::App* each : {call, show, put, measure}) {
              named = named || each->get_option("--id")->count() > 0;
            }
            if (!named && !can && options->protocol == "feetech" && !find->parsed()) {
              require_id({call, show, put, measure});
            }
            if (!named) {
              options->id = can ? canopen::plan::kControllerNode : dxl::controller::kDefaultId;
            }
            check_id(*options, can);
            if (find->parsed()) return can ? scan_can(*options) : scan_serial(*options);
            if (call->parsed()) return can ? ping_can(*options) : ping_serial(*options);
            if (show->parsed()) return can ? read_can(*options) : read_serial(*options);
            if (put->parsed()) return can ? write_can(*options) : write_serial(*options);
            if (measure->parsed()) return can ? bench_can(*options) : bench_serial(*options);
            for (const cli::Subcommand& each : others) {
              if (each.app->parsed()) return each.run();
            }
            if (list->parsed()) cli::answer(bus::controller_document());
            for (const eds::Sheet& each : eds::sheets()) {
              if (sheet->parsed() && options->node == each.node) {
                cli::answer(eds::to_text(each.describe()));
              }
            }
            return int{cli::kGood};
          }};
}

}  // namespace verp::tool
