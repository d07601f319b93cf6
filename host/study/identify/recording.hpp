#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "host/trace/record/trace.hpp"

namespace verp::identify {

/// Goals and positions of all servos, from the first to the last tick with full torque.
struct Recording {
  struct Tick {
    std::uint32_t slot = 0;   ///< control periods since the first tick
    std::uint32_t fresh = 0;  ///< bit j: joint j was read
    std::vector<std::int32_t> goal, position;
  };
  Params params;
  std::vector<Tick> ticks;
  double supply_v = 0;  ///< servos' mean; 0: not reported
  /// Direction against gravity, trunk hanging; without an IMU the body's z.
  Eigen::Vector3d up_body = Eigen::Vector3d::UnitZ();

  double period_s() const { return 1e-6 * params.period_us; }
  double length_s() const {
    return ticks.empty() ? 0 : period_s() * static_cast<double>(ticks.back().slot + 1);
  }
};

/// Replays the controller for its goals. Throws record::TraceError without such a period.
Recording recording_of(const record::Trace& trace);

}  // namespace verp::identify
