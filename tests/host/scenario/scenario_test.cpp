#include "host/run/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <random>

#include "host/robot/model/load_error.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/scenario/text.hpp"

namespace verp::scenario {
namespace {

using session::Intervention;

/// No defaults, different for each draw.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  Scenario scenario() {
    Scenario s{.world = {.file = text(), .physics_step_ms = 0.25 * (1 << below(4))},
               .robots = {},
               .radio = {},
               .length_s = number(3, 100),
               .real_time = flag(),
               .if_lost_go_on = flag(),
               .patience_s = number(1, 100)};
    const int robots = 1 + below(3);
    for (int i = 0; i < robots; ++i) {
      s.robots.push_back(robot());
      s.robots.back().name = "r" + std::to_string(i);
      s.robots.back().at.x_m += 20 * i;
    }
    if (flag())
      s.radio = Radio{.conditions = {.range_m = number(1, 9), .most_bytes = 50}, .seed = 9};
    return s;
  }

 private:
  Robot robot() {
    Robot r;
    r.model = text();
    r.bus = text();
    if (flag()) r.tuning = {{"gait.cycle_s", number(0.3, 2)}, {"gait.lift_m", number(0, 0.06)}};
    if (flag()) r.orders = Velocity{number(-2, 2), number(-2, 2), number(-6, 6)};
    if (flag()) r.orders = Ahead{number(0, 0.15)};
    if (flag()) r.orders = Stand{};
    r.controller.folder = text();
    (flag() ? r.controller.board : r.controller.link) = text();
    r.seed = random_();
    r.vary = flag();
    r.at = {number(-9, 9), number(-9, 9), number(-3, 3)};
    r.lies = static_cast<sim::Lies>(below(6));
    r.get_up = flag();
    r.fault = text();
    if (flag()) {
      r.disturbances.push_back({.kind = Intervention::Kind::kSet,
                                .at_s = number(0, 9),
                                .name = text(),
                                .value = number(-9, 9)});
      r.disturbances.push_back({.kind = Intervention::Kind::kPush,
                                .at_s = number(0, 9),
                                .name = text(),
                                .force_world_n = {number(-9, 9), number(-9, 9), number(-9, 9)},
                                .for_s = number(0.001, 9)});
    }
    return r;
  }

  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool flag() { return below(2) == 1; }
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::string text() { return "\"t\n" + std::to_string(random_()); }

  std::mt19937 random_;
};

/// parse()'s error; empty: accepted.
std::string refusal(const std::string& text) {
  try {
    parse(text, "run.json");
  } catch (const model::LoadError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::string& needle) {
  const std::string line = refusal(text);
  EXPECT_EQ(line.find("run.json: "), 0u) << text << '\n' << line;
  EXPECT_NE(line.find(needle), std::string::npos) << text << '\n' << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

TEST(ScenarioFile, LoadsBackEqualToWhatWasPrinted) {
  EXPECT_EQ(parse(print(Scenario{}), "f"), Scenario{});
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Scenario drawn = Draw(seed).scenario();
    const std::string text = print(drawn);
    EXPECT_EQ(parse(text, "f"), drawn) << text;
    EXPECT_EQ(print(parse(text, "f")), text);
  }
}

TEST(ScenarioFile, LeavesAtItsDefaultWhatItDoesNotName) {
  EXPECT_EQ(parse("{}", "f"), Scenario{});
  Scenario named;
  named.length_s = 5;
  named.robots[0].orders = Velocity{.vx_m_s = 0.1, .vy_m_s = 0, .wz_rad_s = 0};
  EXPECT_EQ(parse(R"({"length_s": 5, "robots": [{"orders": {"velocity": {"vx_m_s": 0.1}}}]})", "f"),
            named);
}

TEST(ScenarioFile, RefusesWhatItDoesNotUnderstandByFileAndKey) {
  expect_refused("", "no JSON");
  expect_refused("[]", "the scenario: is no object");
  expect_refused(R"({"lenght_s": 5})", "lenght_s: there is no such key; give one of: ");
  expect_refused(R"({"length_s": 5, "length_s": 6})", "length_s: the key is there twice");
  expect_refused(R"({"length_s": "5"})", "length_s: \"5\" is not a number");
  expect_refused(R"({"length_s": 1})", "length_s: 1 is out of range; give 3 to 86400");
  expect_refused(R"({"real_time": 1})", "real_time: 1 is not true or false");
  expect_refused(R"({"world": {"file": 3}})", "world.file: 3 is not a text");
  expect_refused(R"({"robots": {}})", "robots: is no list");
  expect_refused(R"({"robots": []})", "robots: 0 robots; give 1 to 16");
  expect_refused(R"({"robots": [{}, {}]})", "robots[0].name: each of several robots needs one");
  expect_refused(R"({"robots": [{"seed": -1}]})", "robots[0].seed: -1 is not a whole number");
  expect_refused(R"({"robots": [{"seed": 1.5}]})", "robots[0].seed: 1.5 is not a whole number");
  expect_refused(R"({"robots": [{"start": "flying"}]})", "robots[0].start: 'flying'");
  expect_refused(R"({"robots": [{"tuning": {"gait.lift": 1}}]})", "robots[0].tuning.gait.lift");
  expect_refused(R"({"robots": [{"tuning": {"gait.lift_m": 1}}]})", "give 0 to 0.06");
  expect_refused(R"({"robots": [{"orders": {"stand": true, "step_m": 0.1}}]})",
                 "robots[0].orders: give one of step_m, velocity, stand");
  expect_refused(R"({"robots": [{"orders": {"stand": false}}]})", "robots[0].orders.stand");
  expect_refused(R"({"robots": [{"disturbances": [{"at_s": 1}]}]})",
                 "robots[0].disturbances[0]: give one of push, set");
  expect_refused(R"({"radio": {"loss": 2}})", "radio: ");
  expect_refused(R"({"world": {"physics_step_ms": 0.7}})", "give one of: 0.25, 0.5, 1, 2");
  expect_refused(R"({"robots": [{"name": "a"}, {"name": "a"}]})",
                 "robots[1].name: robots[0] has it");
  expect_refused(R"({"robots": [{"name": "a"}, {"name": "b"}]})", "robots[1].at: robots[0] stands");
  expect_refused(R"({"robots": [{"controller": {"board": "a", "link": "b"}}]})", "board, link");
}

TEST(Scenario, MakesOnePlanARobotWithThoseDrivenFromOutsideLast) {
  Scenario scenario;
  scenario.robots.resize(2);
  scenario.robots[0].name = "outside";
  scenario.robots[0].controller.link = "unix:nowhere";
  scenario.robots[1].name = "here";
  scenario.robots[1].at.y_m = 1;
  const Expanded run = expand(scenario);
  ASSERT_EQ(run.plans.size(), 2u);
  EXPECT_EQ(run.plans[0].name, "here");
  EXPECT_EQ(run.plans[0].number, 1);
  EXPECT_EQ(run.plans[0].walk_s, scenario.length_s);
  EXPECT_GT(run.plans[1].walk_s, scenario.length_s) << "it rises before and sits down after";
}

TEST(Scenario, AStepThatNobodyChoseIsAtMostTheRobotsLongest) {
  Robot robot;
  robot.tuning["gait.max_step_m"] = 0.01;
  const auto asked = [&](const Ahead& orders) {
    robot.orders = orders;
    return plan_of(robot, 5).asked.value().vx_tenth_mm_s;
  };
  EXPECT_EQ(asked(Ahead{}), asked(Ahead{0.01}));
  EXPECT_EQ(asked(Ahead{0.08}), 3556) << "somebody chose it: 2 * 0.08 m in 0.45 s";
  robot.tuning["gait.max_step_m"] = 0.095;
  EXPECT_EQ(asked(Ahead{}), asked(Ahead{0.04}));
}

TEST(Scenario, RefusesADisturbanceThatTheRunHasNoPlaceFor) {
  const auto where = [](const Intervention& what) {
    Scenario scenario;
    scenario.robots[0].disturbances = {what};
    try {
      expand(scenario);
    } catch (const ScenarioError& error) {
      return error.where + ": " + error.what();
    }
    return std::string();
  };
  const Intervention nobody{
      .kind = Intervention::Kind::kPush, .at_s = 1, .name = "nobody", .for_s = 1};
  EXPECT_EQ(where(nobody).find("robots[0].disturbances[0]: "), 0u) << where(nobody);
  const Intervention late{
      .kind = Intervention::Kind::kSet, .at_s = 99, .name = "trunk.mass_kg", .value = 2};
  EXPECT_NE(where(late).find("99 s is after the end, 20 s"), std::string::npos) << where(late);
}

TEST(Scenario, RefusesTuningThatTheLegsCannotStandWith) {
  Scenario scenario;
  scenario.robots[0].tuning["gait.hip_height_m"] = 1;
  EXPECT_THROW(expand(scenario), ScenarioError);
}

TEST(Scenario, RefusesAFieldBugAmongSeveralRobots) {
  Scenario scenario;
  scenario.robots.resize(2);
  scenario.robots[1].at.y_m = 1;
  expand(scenario);
  scenario.robots[1].fault = "jammed_knee";
  EXPECT_THROW(expand(scenario), ScenarioError);
}

}  // namespace
}  // namespace verp::scenario
