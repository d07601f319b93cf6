#pragma once
#include "host/apps/cli/command.hpp"

namespace verp::tool {

cli::Subcommand add_bus_setup(CLI::App& bus);
cli::Subcommand add_bus_checklist(CLI::App& bus);
cli::Subcommand add_bus_load(CLI::App& bus);
cli::Subcommand add_bus_wire(CLI::App& bus);
cli::Subcommand add_bus_laser(CLI::App& bus);
cli::Subcommand add_bus_camera(CLI::App& bus);
cli::Subcommand add_bus_imu(CLI::App& bus);
cli::Subcommand add_bus_doctor(CLI::App& bus);

}  // namespace verp::tool
