#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "host/trace/record/trace.hpp"

namespace verp::identify {

/// What a trace says of a robot's servos: what each was told, tick by tick, and where it then was.
/// Of that only the ticks from the first to the last in which all servos had their full strength.
struct Recording {
  /// Of one tick. Counts of each joint.
  struct Tick {
    std::uint32_t slot = 0;   ///< control periods since the first one here
    std::uint32_t fresh = 0;  ///< bit j: joint j was read
    std::vector<std::int32_t> goal, position;
  };
  Params params;
  std::vector<Tick> ticks;
  double supply_v = 0;  ///< mean of what the servos told; 0: none did
  /// Against gravity, as the trunk hung in its stand; upright where there is no IMU.
  Eigen::Vector3d up_body = Eigen::Vector3d::UnitZ();

  double period_s() const { return 1e-6 * params.period_us; }
  double length_s() const {
    return ticks.empty() ? 0 : period_s() * static_cast<double>(ticks.back().slot + 1);
  }
};

/// Runs the controller over the trace once more: goals are what it decides. Throws
/// record::TraceError for a trace that holds no such time.
Recording recording_of(const record::Trace& trace);

}  // namespace verp::identify
