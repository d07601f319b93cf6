#pragma once
#include "host/apps/tool/bus_options.hpp"

/// `verp bus scan|ping|read|write|bench` on CAN, with nodes and objects instead of devices and
/// registers. Objects in our EDS data (host/twin/eds) have a name and a type; others print as
/// bytes.
namespace verp::tool {

/// True if --link names a CAN interface; throws link::EndpointError if it names nothing.
bool on_can(const BusOptions& options);

int scan_can(const BusOptions& options);
int ping_can(const BusOptions& options);
int read_can(const BusOptions& options);
int write_can(const BusOptions& options);
int bench_can(const BusOptions& options);

}  // namespace verp::tool
