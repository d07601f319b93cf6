#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host/apps/demos/run.hpp"
#include "tests/scenario/walk.hpp"

namespace verp::scenario {

inline const demos::Demo& demo_of(const std::string& name) {
  const auto& all = demos::all_demos();
  return *std::find_if(all.begin(), all.end(),
                       [&](const demos::Demo& each) { return each.name == name; });
}

inline demos::Run good(const std::string& name, std::uint64_t seed, demos::Options options = {}) {
  EXPECT_LE(seed, kLastGateSeed) << "seeds.txt";
  options.seed = seed;
  demos::Run run = demos::run(demo_of(name), options);
  EXPECT_EQ(run.verdict.failure, "") << name << ", seed " << seed;
  return run;
}

inline void expect_fact(const demos::Run& run, const std::string& name, double low, double high) {
  const auto fact = std::find_if(run.verdict.facts.begin(), run.verdict.facts.end(),
                                 [&](const demos::Fact& each) { return each.name == name; });
  ASSERT_NE(fact, run.verdict.facts.end()) << name;
  expect_between(low, fact->value, high, name.c_str());
}

}  // namespace verp::scenario
