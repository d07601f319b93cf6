#include "host/run/scenario/probe.hpp"

#include "host/twin/sim/scenery.hpp"

namespace verp::scenario {

Probe::Probe(const Expanded& run) : world(run.world), quantities(world) {
  if (world.scenery() != nullptr) quantities.add(*world.scenery());
  for (const session::WalkPlan& plan : run.plans) {
    robots.emplace_back(world, plan.entity, plan.twin);
    quantities.add(robots.back(), run.plans.size() == 1 ? "" : plan.name + ".");
  }
}

}  // namespace verp::scenario
