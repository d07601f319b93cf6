#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/model/entity.hpp"
#include "host/record/trace_writer.hpp"
#include "host/sim/metrics.hpp"
#include "host/tool/progress.hpp"

namespace verp::tool {

/// One walk of one robot, fully determined by these values.
struct WalkPlan {
  model::Entity entity;
  Params params;
  Command velocity;  ///< vx, vy, wz
  double walk_s = 20;
  std::uint64_t seed = 1;
  std::string board;  ///< emulated board that runs the controller; empty: this process
};

/// What a CAN bus carried in a walk, from its first tick on.
struct CanTraffic {
  double bits_per_tick = 0, bare_bits_per_tick = 0;  ///< with and without stuff bits
  std::uint32_t overruns = 0;                        ///< frames that the controller lost
};

struct WalkResult {
  sim::WalkMetrics metrics;
  std::vector<sim::SeriesRow> series;  ///< from the first tick on
  std::uint64_t ticks = 0;
  std::uint64_t digest = 0;
  std::uint32_t faults = 0;   ///< safety::Fault bits at the end
  double longest_step_m = 0;  ///< that the gait made: the asked one, or what limits left of it
  double simulated_s = 0, wall_s = 0;
  bool interrupted = false;
  std::optional<CanTraffic> can;  ///< of a walk over CAN
  std::string trace_failure;  ///< why the trace breaks off; the walk went on. Empty: it does not
  std::string failure;        ///< why the walk is no good, in words; empty: it is good
  std::string remark;         ///< how a good walk is not what was asked; empty: it is

  bool good() const { return failure.empty() && !interrupted; }
  double real_time_factor() const { return wall_s > 0 ? simulated_s / wall_s : 0; }
};

/// Closed loop: the firmware/app loop talks Dynamixel bytes to virtual servos on the twin, in this
/// process or on an emulated board, or, in this process, CAN frames to virtual drives. `trace` (may
/// be null) gets every tick. Ends by itself when the gait is over, the robot has fallen, or
/// somebody interrupts. Throws ToolError when the robot does not come up.
WalkResult walk(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
                const std::string& label, bool keep_series);

/// Names of the fault bits that are set, e.g. "fall, servo silent"; empty when none.
std::string fault_names(std::uint32_t faults);

}  // namespace verp::tool
