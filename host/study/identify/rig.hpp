#pragma once
#include <cstdint>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/study/identify/recording.hpp"

namespace verp::identify {

/// Where a twin's joints were at the ticks of a recording, told the same goals.
struct Simulated {
  std::vector<std::vector<float>> count;  ///< [joint][tick], not rounded, without noise
  double supply_v = 0;                    ///< mean
};

struct RigOptions {
  int delay_steps = 0;  ///< more between a goal's arrival and its servo; at least kLeastDelay
  double supply_v = 12;
  std::size_t ticks = 0;  ///< of the recording, from its first on
  std::uint64_t seed = 1;
};

inline constexpr std::uint32_t kStep_us = 1000;  ///< of the twin's physics

inline constexpr int kLeastDelay = -1;

Simulated simulate(const model::Entity& entity, const Recording& recording,
                   const RigOptions& options);

/// From a tick's beginning, us: when the servos are read, and when they have their goals.
struct TickTimes {
  std::uint32_t read_us = 0, goal_us = 0;
};
TickTimes times_of(const Params& params);

}  // namespace verp::identify
