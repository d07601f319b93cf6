#pragma once
#include <cstdint>
#include <string>

#include "firmware/app/bus_counters.hpp"
#include "firmware/app/pacer.hpp"
#include "hal/contract/byte_link.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/apps/tool/walk_run.hpp"
#include "host/os/imu/imu_port.hpp"
#include "host/os/link/link.hpp"
#include "host/os/link/stop_line.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "host/twin/bus/link_fit.hpp"

namespace verp::tool {

struct RunPlan {
  WalkPlan walk;  ///< Params of this PC's controller
  link::Endpoint link;
  bool has_imu = true;              ///< false: `--imu none`
  std::string imu_name;             ///< of an IMU of this PC; empty: none
  imu::ImuPort* own_imu = nullptr;  ///< open; null: none
  link::StopLine* stop = nullptr;   ///< a button at this PC; null: none
  int torque_percent = 100;
  bool lockstep = false;
  int action = 0;             ///< instead of a walk; 0: walk
  bool takes_orders = false;  ///< `--take-orders`, through the controller's node
};

struct RunResult {
  WalkResult walk;              ///< only ticks, digest, faults, failure, interrupted
  bool device_trouble = false;  ///< link or device caused walk.failure
  double walked_s = 0, played_s = 0;
  std::string ended;  ///< "lies on its front"
  bus::LinkFit fit;
  cli::RealTime real_time;
  app::Deadlines deadlines;
  app::BusCounters bus;
  std::uint32_t crc_errors = 0;
  hal::LinkErrors link;
  int silent_servos = 0;  ///< at the end, torque unknown
  int stiff_servos = 0;   ///< at the end, with torque
};

/// The link's delay of a read. Throws ToolError with the remedy if a tick cannot fit.
bus::LinkFit check_latency(link::Link& link, const RunPlan& plan);

void check_imu(link::Link& link, const RunPlan& plan);

/// Drives until the walk ends or an interrupt, then releases torque. `trace` may be null. Throws
/// ToolError if bring-up fails.
RunResult drive(link::Link& link, const RunPlan& plan, const bus::LinkFit& fit,
                record::TraceWriter* trace, cli::Progress& progress);

}  // namespace verp::tool
