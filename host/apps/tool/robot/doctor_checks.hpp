#pragma once
#include <string>

#include "host/apps/tool/robot/doctor_machine.hpp"
#include "host/apps/tool/robot/doctor_report.hpp"

/// The checks of `verp doctor`. Each gives at least one finding. Bad: walking in the twin would
/// fail, or a device that is plugged in cannot be used.
namespace verp::tool {

/// `list`: the text of toolchains/packages.txt; empty: an installed VERP.
void check_packages(const Machine& machine, const std::string& list, Findings& found);
void check_environment(const Machine& machine, Findings& found);
void check_disk(const Machine& machine, Findings& found);
void check_other_programs(const Machine& machine, Findings& found);
void check_display(const Machine& machine, Findings& found);
void check_real_time(const Machine& machine, Findings& found);
void check_serial_ports(const Machine& machine, Findings& found);
/// Boards, probes and adapters on USB.
void check_usb(const Machine& machine, Findings& found);
void check_i2c(const Machine& machine, Findings& found);
void check_can(const Machine& machine, Findings& found);

Findings examine(const Machine& machine, const std::string& packages);

/// Permission, holders and latency of one device; finds nothing if all is good. False: it cannot be
/// opened, or is another program's.
bool check_device(const Machine& machine, const std::string& device, Findings& found);

}  // namespace verp::tool
