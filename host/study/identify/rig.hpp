#pragma once
#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

#include "host/robot/model/entity.hpp"
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

/// A twin's joint positions at a recording's ticks.
struct Simulated {
  std::vector<std::vector<float>> count;  ///< [joint][tick], not rounded, no noise
  double supply_v = 0;                    ///< mean
};

struct RigOptions {
  int delay_steps = 0;  ///< extra, from arrival to servo; >= kLeastDelay
  double supply_v = 12;
  std::size_t ticks = 0;  ///< from the recording's first
  std::uint64_t seed = 1;
};

inline constexpr std::uint32_t kStep_us = 1000;  ///< of the twin's physics

inline constexpr int kLeastDelay = -1;

Simulated simulate(const model::Entity& entity, const Recording& recording,
                   const RigOptions& options);

/// Times after a tick's start, us, at which servos are read and have their goals.
struct TickTimes {
  std::uint32_t read_us = 0, goal_us = 0;
};
TickTimes times_of(const Params& params);

}  // namespace verp::identify
