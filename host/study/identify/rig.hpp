#pragma once
#include <cstdint>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/study/identify/recording.hpp"

namespace verp::identify {

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
