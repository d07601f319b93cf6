#include <CLI/CLI.hpp>
#include <memory>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/robot/commands.hpp"
#include "host/apps/tool/robot/doctor_checks.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"

namespace verp::tool {

Findings examine(const Machine& machine, const std::string& packages) {
  Findings found;
  check_packages(machine, packages, found);
  check_environment(machine, found);
  check_disk(machine, found);
  check_other_programs(machine, found);
  check_display(machine, found);
  check_real_time(machine, found);
  check_serial_ports(machine, found);
  check_usb(machine, found);
  check_can(machine, found);
  check_i2c(machine, found);
  return found;
}

cli::Subcommand add_doctor(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "doctor");
  auto json = std::make_shared<bool>(false);
  cli::add_json_flag(*app, *json);
  return {app, [json] {
            const auto list = files::read(files::source_dir() / "toolchains/packages.txt");
            const Findings found = examine(Machine(), list.value_or(""));
            cli::print_answer(*json, found.json(), found.text());
            return int{found.any_bad() ? cli::kRunFailed : cli::kGood};
          }};
}

}  // namespace verp::tool
