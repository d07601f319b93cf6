#pragma once
#include "host/apps/tool/run_robot.hpp"
#include "host/os/link/can_port.hpp"

/// `verp run` for CiA 402 drives on a CAN interface, with the plan and result of run_robot.hpp.
namespace verp::tool {

/// Listens for slightly more than a controller's heartbeat period. Throws ToolError if it hears a
/// controller, because a bring-up resets all nodes and would drop that controller's robot.
void refuse_second_controller(link::CanPort& port, const RunPlan& plan);

/// Measures the extra delay of SDO answers. Throws ToolError with the remedy if a tick does not
/// fit; its SYNCs each wait for answers in turn.
bus::LinkFit check_latency(link::CanPort& port, const RunPlan& plan);

/// Throws ToolError if no IMU answers.
void check_imu(link::CanPort& port, const RunPlan& plan);

/// As on a serial bus. The controller is also a node (firmware/app/operator_node.hpp): it reports
/// each tick if its bus has room, and others can read its registers.
RunResult drive(link::CanPort& port, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress);

}  // namespace verp::tool
