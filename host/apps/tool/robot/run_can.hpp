#pragma once
#include "host/apps/tool/robot/run_robot.hpp"
#include "host/os/link/can_port.hpp"

/// `verp run` on CAN, with run_robot.hpp's plan and result.
namespace verp::tool {

/// Listens for a controller's heartbeat period. Throws ToolError if it hears one: a bring-up resets
/// all nodes and would drop that controller's robot.
void refuse_second_controller(link::CanPort& port, const RunPlan& plan);

/// Extra delay of SDO answers. Throws ToolError with the remedy if a tick does not fit.
bus::LinkFit check_latency(link::CanPort& port, const RunPlan& plan);

void check_imu(link::CanPort& port, const RunPlan& plan);

RunResult drive(link::CanPort& port, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress);

}  // namespace verp::tool
