#include "host/apps/demos/goal_demo.hpp"

#include <fmt/format.h>

#include "host/apps/demos/brain/goal.hpp"
#include "host/apps/demos/judge.hpp"

namespace verp::demos {
namespace {

constexpr brain::Point kGoal{3.0, 0.9};  // from the start, which is the world's origin

Verdict judge_goal(const Run& run) {
  constexpr double kThere_m = 0.25;
  const Track& track = run.robots.front();
  const std::vector<brain::Point> way = smooth(track);
  const double left_m = distance(way.back(), kGoal), straight_m = length(kGoal);
  Verdict verdict;
  verdict.facts = {{"from the goal at the end", left_m, "m"},
                   {"way", way_m(track), "m"},
                   {"straight on it would be", straight_m, "m"},
                   {"touches", static_cast<double>(track.touches), ""},
                   {"odometry's drift", drift_m(track), "m"}};
  if (track.touches > 0) verdict.failure = "it touched something";
  if (left_m > kThere_m) verdict.failure = fmt::format("it ended {:.2f} m from the goal", left_m);
  if (!track.done_s) verdict.failure = fmt::format("it was not there in {:.0f} s", run.length_s);
  return verdict;
}

}  // namespace

Demo goal_demo() {
  return {.name = "goal",
          .what = "one goes to a goal through rooms that it maps by its laser",
          .criterion = "it stops within 0.25 m of the goal, and touches nothing",
          .fewest = 1,
          .usual = 1,
          .most = 1,
          .length_s = 110,
          .world = "rooms",
          .places = [](int) { return std::vector<brain::Pose>{{}}; },
          .brain = [](const brain::About& about) { return brain::make_goal_goer(about, kGoal); },
          .judge = judge_goal,
          .marks = {kGoal}};
}

}  // namespace verp::demos
