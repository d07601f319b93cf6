#include "host/apps/demos/ball_demo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/apps/demos/brain/ball.hpp"
#include "host/apps/demos/judge.hpp"

namespace verp::demos {
namespace {

constexpr double kPost_m = 0.7;  // from the goal's middle, as in common/worlds/pitch

std::vector<brain::Pose> on_the_pitch(int robots) {
  std::vector<brain::Pose> places = {{{-0.5, 0.5}, 0}, {{-0.9, -0.6}, 0}};
  places.resize(static_cast<std::size_t>(robots));
  return places;
}

/// Where the ball first crossed the goal line; empty if it did not.
std::optional<double> crossed_m(const ThingTrack& ball) {
  const double line_m = brain::kGoalMiddle.x;
  for (std::size_t i = 1; i < ball.at_m.size(); ++i) {
    const brain::Point a = ball.at_m[i - 1], b = ball.at_m[i];
    if (a.x < line_m && b.x >= line_m) return a.y + (b.y - a.y) * (line_m - a.x) / (b.x - a.x);
  }
  return std::nullopt;
}

Verdict judge_ball(const Run& run) {
  constexpr double kAhead_m = 1, kTouched_m = 0.03;
  Verdict verdict;
  const ThingTrack& ball = run.things.front();
  double furthest_m = -1e9, begun_s = 0;
  for (const brain::Point at : ball.at_m) furthest_m = std::max(furthest_m, at.x);
  for (std::size_t i = 0; i < ball.at_m.size(); ++i) {
    begun_s = run.robots.front().moments[i].time_s;
    if (distance(ball.at_m[i], ball.at_m.front()) > kTouched_m) break;
  }
  const std::optional<double> crossed = crossed_m(ball);
  verdict.facts = {{"ball's way ahead", furthest_m - ball.at_m.front().x, "m"},
                   {"first touched after", begun_s, "s"}};
  if (crossed) verdict.facts.push_back({"over the line beside its middle by", *crossed, "m"});
  for (const Track& track : run.robots) {
    verdict.facts.push_back({track.name + " odometry's drift", drift_m(track), "m"});
  }
  const bool goal = crossed && std::abs(*crossed) < kPost_m;
  verdict.facts.insert(verdict.facts.begin(), {"goals", goal ? 1.0 : 0.0, ""});
  const double ahead_m = furthest_m - ball.at_m.front().x;
  if (!goal && ahead_m < kAhead_m) {
    verdict.failure = ahead_m < kTouched_m ? "nobody touched the ball"
                                           : fmt::format("the ball came {:.2f} m ahead", ahead_m);
  }
  return verdict;
}

}  // namespace

Demo ball_demo() {
  return {.name = "ball",
          .what = "two robots see a ball and bring it into a goal",
          .criterion = "a goal, or the ball brought 1 m ahead; nobody falls",
          .fewest = 1,
          .usual = 2,
          .most = 2,
          .length_s = 90,
          .world = "pitch",
          .cameras = true,
          .places = on_the_pitch,
          .brain = brain::make_player,
          .judge = judge_ball,
          .marks = {brain::kGoalMiddle}};
}

}  // namespace verp::demos
