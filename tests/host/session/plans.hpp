#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"

namespace verp::session::test {

inline constexpr double kWalk_s = 2.0;

/// `left_m` left of the origin.
inline WalkPlan plan_of(const std::string& bus, double left_m = 0, std::uint64_t seed = 1) {
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model("generic21"), bus);
  plan.params = model::make_params(plan.entity);
  plan.velocity.vx_tenth_mm_s = 1000;
  plan.walk_s = kWalk_s;
  plan.twin.seed = seed;
  plan.twin.start_m.y() = left_m;
  return plan;
}

using Chain = std::vector<std::uint64_t>;

inline Hooks keep(Chain& chain) {
  Hooks hooks;
  hooks.ticked = [&chain](const Tick& tick) { chain.push_back(tick.record->digest.chain); };
  return hooks;
}

inline Chain alone(const WalkPlan& plan) {
  Chain chain;
  const WalkResult result = walk(plan, keep(chain));
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.ticks, chain.size());
  EXPECT_GT(result.metrics.distance_m, 0.04);
  return chain;
}

}  // namespace verp::session::test
