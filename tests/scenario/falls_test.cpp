#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

int count(const Walk& walk, const char* name) {
  return walk.result.value(name, -1);
}

TEST(GettingUp, FromItsBackItStandsAndWalks) {
  const Walk lying = walk("generic21 --for 3 --physics-step 2 --start lying:back");
  expect_walked(lying);
  EXPECT_GE(count(lying, "get_ups"), 1);
  expect_between(0.1, number(lying, "distance_m"), 0.4, "distance, m");
}

// It rolls over its left side. 23 s suffice for one try and the walk, not for two.
TEST(GettingUp, FromItsFrontItRollsOntoItsBackAndGetsUp) {
  const Walk lying = walk("generic21 --for 3 --physics-step 2 --start lying:front");
  expect_walked(lying);
  EXPECT_EQ(count(lying, "get_ups"), 1);
  expect_between(1500, number(lying, "ticks"), 2300, "ticks of 10 ms");
  expect_between(0.1, number(lying, "distance_m"), 0.4, "distance, m");
}

TEST(GettingUp, FromEitherSideItTipsOntoItsBackAndGetsUp) {
  for (const std::string side : {"left", "right"}) {
    const Walk lying = walk("generic21 --for 3 --physics-step 2 --start lying:" + side);
    expect_walked(lying);
    EXPECT_GE(count(lying, "get_ups"), 1) << side;
  }
}

// The promise: 97 of a hundred; of four and more, all but one.
void expect_up(const std::string& robot, const std::string& side, int robots) {
  const Walk seeds = walk(robot + " --vary --for 3 --physics-step 2 --seeds 1-" +
                          std::to_string(robots) + " --start lying:" + side);
  EXPECT_GE(number(seeds, "survived"), robots < 4 ? robots : robots - 1) << side;
}

TEST(GettingUp, TwoRandomOnesDoItToo) {
  for (const char* side : {"back", "front"}) expect_up("generic21", side, 2);
}
TEST(GettingUp, EightRandomOnesDoItToo) {
  for (const char* side : {"back", "front"}) expect_up("generic21", side, 8);
}

// Strong arms push it up; its sides tip it onto the back.
TEST(GettingUp, Op3DoesItFromEverySide) {
  for (const std::string side : {"back", "front", "left", "right"}) {
    const Walk lying = walk("op3 --for 3 --physics-step 2 --start lying:" + side);
    expect_walked(lying);
    EXPECT_GE(count(lying, "get_ups"), 1) << side;
  }
}

// Its arms are too short to lift it over drawn-in feet, so it squats between hands and soles.
TEST(GettingUp, DarwinOpDoesItFromEverySideAtTheFirstTry) {
  for (const std::string side : {"back", "front", "left", "right"}) {
    const Walk lying = walk("darwin_op --for 3 --physics-step 2 --start lying:" + side);
    expect_walked(lying);
    EXPECT_EQ(count(lying, "get_ups"), 1) << side;
  }
}

TEST(GettingUp, RandomDarwinOpsDoItToo) {
  for (const char* side : {"back", "front", "left", "right"}) expect_up("darwin_op", side, 4);
}

TEST(GettingUp, PushedOverItFallsGetsUpAndWalksOn) {
  const Walk pushed =
      walk("generic21 --for 5 --physics-step 2 --get-up --push '2: trunk -60,0,0 N for 0.15'");
  expect_walked(pushed);
  EXPECT_EQ(count(pushed, "falls"), 1);
  EXPECT_GE(count(pushed, "get_ups"), 1);
  EXPECT_EQ(pushed.result.value("notes", "?").find("fall"), std::string::npos) << "it is over";
}

TEST(GettingUp, UnaskedItStaysDown) {
  const Walk pushed =
      walk("generic21 --for 5 --physics-step 2 --push '2: trunk 60,0,0 N for 0.15'");
  EXPECT_EQ(pushed.status, 1);
  EXPECT_EQ(pushed.result.value("fallen", false), true);
  EXPECT_EQ(count(pushed, "get_ups"), 0);
}

TEST(GettingUp, IsRepeatableToTheBit) {
  const std::string tour =
      "generic21 --for 4 --physics-step 2 --start lying:back --push '1: trunk -60,0,0 N for 0.15'";
  const Walk once = walk(tour), again = walk(tour);
  EXPECT_EQ(count(once, "falls"), 1);
  EXPECT_EQ(once.result.at("digest"), again.result.at("digest"));
}

}  // namespace
}  // namespace verp::scenario
