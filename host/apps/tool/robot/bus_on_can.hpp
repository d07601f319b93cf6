#pragma once
#include "host/apps/tool/robot/bus_options.hpp"

/// `verp bus scan|ping|read|write|bench` on CAN, with nodes and objects. Objects outside our EDS
/// data (host/twin/eds) print as bytes.
namespace verp::tool {

/// True if --link names a CAN interface. Throws link::EndpointError if it names nothing.
bool on_can(const BusOptions& options);

int scan_can(const BusOptions& options);
int ping_can(const BusOptions& options);
int read_can(const BusOptions& options);
int write_can(const BusOptions& options);
int bench_can(const BusOptions& options);

}  // namespace verp::tool
