#pragma once
#include <deque>

#include "host/run/scenario/expand.hpp"
#include "host/twin/sim/quantities.hpp"

namespace verp::scenario {

/// Quantities and things of a run, without running it.
struct Probe {
  explicit Probe(const Expanded& run);

  sim::World world;
  std::deque<sim::TwinRobot> robots;
  sim::Quantities quantities;
};

}  // namespace verp::scenario
