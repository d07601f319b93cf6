#pragma once
#include "host/apps/tool/run_robot.hpp"
#include "host/os/link/can_port.hpp"

/// `verp run` of CiA 402 drives on a CAN interface: as run_robot.hpp, from which the plan and the
/// result are.
namespace verp::tool {

/// Listens for a little more than the period of a controller's heartbeat, and throws ToolError if
/// there is one: a bring-up begins with a reset of all nodes, which would drop its robot.
void refuse_second_controller(link::CanPort& port, const RunPlan& plan);

/// Measures how long answers to SDO requests are held up, and throws ToolError with the remedy if a
/// tick, whose SYNCs wait for answers one after the other, can't fit.
bus::LinkFit check_latency(link::CanPort& port, const RunPlan& plan);

/// Throws ToolError if the robot has no IMU that answers.
void check_imu(link::CanPort& port, const RunPlan& plan);

/// As on a serial bus. The controller is a node there, too (firmware/app/operator_node.hpp): it
/// tells of each tick, where its bus has room for it, and who asks reads its registers.
RunResult drive(link::CanPort& port, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress);

}  // namespace verp::tool
