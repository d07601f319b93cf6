#pragma once
#include "host/apps/tool/robot/bus_options.hpp"

/// `verp bus scan|ping|read|write|bench` for devices on any byte link.
namespace verp::tool {

int scan_serial(const BusOptions& options);
int ping_serial(const BusOptions& options);
int read_serial(const BusOptions& options);
int write_serial(const BusOptions& options);
int bench_serial(const BusOptions& options);

}  // namespace verp::tool
