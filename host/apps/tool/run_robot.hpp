#pragma once
#include <cstdint>
#include <string>

#include "firmware/app/bus_master.hpp"
#include "firmware/app/pacer.hpp"
#include "hal/contract/byte_link.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/os/link/link.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/bus/link_fit.hpp"

namespace verp::tool {

/// A robot at the other end of a link, and how it is to be driven.
struct RunPlan {
  WalkPlan walk;  ///< its Params as this PC's controller takes them
  link::Endpoint link;
  bool has_imu = true;  ///< false: `--imu none`
  int torque_percent = 100;
  bool lockstep = false;      ///< of a twin: it waits for this controller, and that for it
  int action = 0;             ///< of the library in `walk`, played instead of a walk; 0: a walk
  bool takes_orders = false;  ///< `--take-orders`: who writes the controller's node gives them
};

struct RunResult {
  WalkResult walk;              ///< what needs no twin: ticks, digest, faults, failure, interrupted
  bool device_trouble = false;  ///< walk.failure is the link's or a device's
  double walked_s = 0, played_s = 0;
  bus::LinkFit fit;
  cli::RealTime real_time;
  app::Deadlines deadlines;
  app::BusCounters bus;
  std::uint32_t crc_errors = 0;
  hal::LinkErrors link;
  int silent_servos = 0;  ///< at the end: that could not be asked whether they let go
  int stiff_servos = 0;   ///< at the end: that said they did not
};

/// Measures what the link makes of a read, and throws ToolError with the remedy if a tick can't
/// fit.
bus::LinkFit check_latency(link::Link& link, const RunPlan& plan);

/// Throws ToolError if the robot has no IMU that answers.
void check_imu(link::Link& link, const RunPlan& plan);

/// Drives the robot until the walk is over or somebody interrupts, and lets go of it. `trace` may
/// be null. Throws ToolError if the robot does not come up.
RunResult drive(link::Link& link, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress);

}  // namespace verp::tool
