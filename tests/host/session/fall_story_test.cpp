#include "host/run/session/fall_story.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "host/run/session/get_up.hpp"

namespace verp::session::test {
namespace {

using safety::Mode;

std::string tell(FallStory& story, Mode mode, float up_x, float up_y) {
  State state;
  state.attitude.up_body.x = up_x;
  state.attitude.up_body.y = up_y;
  Outputs outputs;
  outputs.mode = static_cast<std::uint8_t>(mode);
  return story.observe(state, outputs);
}

TEST(FallStory, TellsAFallAndEachTryOnceAndCountsThem) {
  FallStory story(3);
  EXPECT_EQ(tell(story, Mode::kRising, 0, 0), "");
  EXPECT_EQ(tell(story, Mode::kWalking, 0, 0), "");
  EXPECT_EQ(tell(story, Mode::kFalling, 0.5F, 0), "falls, limbs in and soft");
  EXPECT_EQ(tell(story, Mode::kFalling, 0.9F, 0), "") << "once";
  EXPECT_EQ(tell(story, Mode::kFallen, 1, 0.1F), "lies on its back");
  EXPECT_EQ(tell(story, Mode::kGettingUp, 1, 0), "gets up, try 1 of 3");
  EXPECT_EQ(tell(story, Mode::kFallen, -1, 0.2F), "lies on its front: try 1 of 3 failed");
  EXPECT_EQ(tell(story, Mode::kGettingUp, -1, 0), "gets up, try 2 of 3");
  EXPECT_EQ(tell(story, Mode::kStanding, 0, 0), "stands again");
  EXPECT_EQ(story.falls(), 1);
  EXPECT_EQ(story.get_ups(), 1);
  EXPECT_EQ(tell(story, Mode::kFallen, 0, -1), "lies on its left side");
  EXPECT_EQ(tell(story, Mode::kGettingUp, 0, -1), "gets up, try 1 of 3") << "they count anew";
}

TEST(FallStory, SaysHowOneLiesThatNobodySawFall) {
  FallStory story;
  EXPECT_EQ(tell(story, Mode::kGettingUp, 0.2F, 1), "lies on its right side; gets up, try 1");
  EXPECT_EQ(tell(story, Mode::kStanding, 0, 0), "stands again");
  EXPECT_EQ(story.falls(), 0);
}

TEST(FallStory, OneThatWasCaughtNeverLay) {
  FallStory story(3);
  tell(story, Mode::kWalking, 0, 0);
  tell(story, Mode::kFalling, 0.5F, 0);
  EXPECT_EQ(tell(story, Mode::kHolding, 0, 0), "was caught, and rises anew");
  EXPECT_EQ(story.falls(), 0);
}

TEST(GetUp, AsksThreeTimesInARowThenNoMore) {
  using Phase = GetUp::Phase;
  GetUp up(3);
  EXPECT_EQ(up.observe(Mode::kWalking, 0.008), Phase::kUp);
  for (int attempt = 0; attempt < 3; ++attempt) {
    EXPECT_EQ(up.observe(Mode::kFallen, 0.008), Phase::kFell) << attempt;
    EXPECT_EQ(up.observe(Mode::kFallen, 0.008), Phase::kDown) << attempt;
    EXPECT_EQ(up.observe(Mode::kGettingUp, 0.008), Phase::kDown) << attempt;
  }
  EXPECT_EQ(up.observe(Mode::kFallen, 0.008), Phase::kGaveUp);
  EXPECT_FALSE(up.down());
  EXPECT_EQ(up.observe(Mode::kFallen, 0.008), Phase::kUp) << "that it still lies is no new fall";
}

TEST(GetUp, OneThatStoodHasAllItsTriesAgain) {
  GetUp up(1);
  for (int fall = 0; fall < 3; ++fall) {
    up.observe(Mode::kFallen, 0.008);
    up.observe(Mode::kGettingUp, 0.008);
    EXPECT_EQ(up.observe(Mode::kStanding, 0.008), GetUp::Phase::kUp) << fall;
    EXPECT_FALSE(up.down());
  }
}

TEST(GetUp, WhoIsNeverHeardToLieIsGivenUpAfterAMinute) {
  GetUp up(3, true);
  EXPECT_EQ(up.observe(Mode::kRelaxed, 59), GetUp::Phase::kDown);
  EXPECT_EQ(up.observe(Mode::kRelaxed, 2), GetUp::Phase::kGaveUp);
  GetUp never(0, true);
  EXPECT_EQ(never.observe(Mode::kFallen, 99), GetUp::Phase::kUp) << "nobody asks for it";
}

}  // namespace
}  // namespace verp::session::test
