#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "host/trace/record/trace.hpp"

namespace verp::identify {

/// Goals and measured positions of all servos, tick by tick, from the first to the last tick in
/// which all servos had full torque.
struct Recording {
  /// Counts of each joint in one tick.
  struct Tick {
    std::uint32_t slot = 0;   ///< control periods since the first tick here
    std::uint32_t fresh = 0;  ///< bit j: joint j was read
    std::vector<std::int32_t> goal, position;
  };
  Params params;
  std::vector<Tick> ticks;
  double supply_v = 0;  ///< mean of the servos' reports; 0: no servo reported it
  /// Direction against gravity of the hanging trunk; the body's z without an IMU.
  Eigen::Vector3d up_body = Eigen::Vector3d::UnitZ();

  double period_s() const { return 1e-6 * params.period_us; }
  double length_s() const {
    return ticks.empty() ? 0 : period_s() * static_cast<double>(ticks.back().slot + 1);
  }
};

/// Replays the controller over the trace to obtain its goals. Throws record::TraceError for a trace
/// without such a period.
Recording recording_of(const record::Trace& trace);

}  // namespace verp::identify
