#pragma once
#include "host/apps/tool/bus_options.hpp"

/// `verp bus scan|ping|read|write|bench` on CAN: nodes instead of devices, objects instead of
/// registers. An object that stands in one of our data sheets (host/twin/eds) has a name and a
/// type; any other is shown as the bytes it has.
namespace verp::tool {

/// Whether --link names a CAN interface; throws link::EndpointError if it names nothing.
bool on_can(const BusOptions& options);

int scan_can(const BusOptions& options);
int ping_can(const BusOptions& options);
int read_can(const BusOptions& options);
int write_can(const BusOptions& options);
int bench_can(const BusOptions& options);

}  // namespace verp::tool
