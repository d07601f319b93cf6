#include <gtest/gtest.h>

#include "host/author/action/words.hpp"
#include "tests/host/action/robots.hpp"
#include "tests/unit/support/coupled_robot.hpp"

namespace verp::action {
namespace {

using test::generic21;
using test::refusal;

constexpr const char* kAll =
    "action all\nnote Every word there is\n"
    "frame a 0.5 hold 0.1\n  smooth\n  stance left\n  balance off\n  over left 0.8\n"
    "  body x 0.01 pitch 5\n  left_foot z 0.01\n  right_foot x 0.02 yaw 10\n"
    "  head_yaw 20\n  l_elbow stand-10\n  stiff 60 head_yaw\n  exit b\n"
    "frame b 0.4\n  cubic\n  wait upright 2 else stand\n"
    "frame 0.3\n  repeat 2 from b\nlink all2\n";

TEST(ActionText, IsWrittenAsItIsRead) {
  const Document document = parse_document("all.action", kAll);
  ASSERT_EQ(document.frames.size(), 3U);
  const std::string text = text_of(document);
  EXPECT_EQ(text_of(parse_document("all.action", text)), text);
  for (const char* word :
       {"hold 0.1", "stance left", "over left 0.8", "yaw 10", "stand-10", "stiff 60 head_yaw",
        "wait upright 2 else stand", "repeat 2 from b", "link all2", "exit b", "cubic"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word;
  }
}

// `frame 1` would begin a frame.
TEST(ActionText, AJointNamedLikeAWordOfTheTextIsNoSuchWord) {
  Document document = parse_document("all.action", kAll);
  const std::size_t frames = document.frames.size();
  for (const char* word : kLineWords) {
    document.frames[0].goals = {{.joint = word, .from_stand = false, .angle_rad = 0.5, .line = 1}};
    const Document again = parse_document("all.action", text_of(document));
    ASSERT_EQ(again.frames.size(), frames) << word;
    ASSERT_EQ(again.frames[0].goals.size(), 1U) << word;
    EXPECT_EQ(again.frames[0].goals[0].joint, word);
    EXPECT_NEAR(again.frames[0].goals[0].angle_rad, 0.5, 1e-6) << word;
  }
}

// `place`: file and line.
void expect_refused(const std::string& place, const std::string& what,
                    const std::vector<std::string>& texts) {
  const std::string why = refusal(texts);
  EXPECT_EQ(why.substr(0, place.size()), place) << why;
  EXPECT_NE(why.find(what), std::string::npos) << why;
}

TEST(ActionText, MistakesAreNamedWithFileAndLine) {
  expect_refused("a1.action:3:", "no joint 'tail'", {"action a\nframe 1\n tail 20\n"});
  expect_refused("a1.action:2:", "out of range", {"action a\nframe -1\n head_yaw 20\n"});
  expect_refused("a1.action:3:", "beyond its limits", {"action a\nframe 1\n head_yaw 170\n"});
  expect_refused("a1.action:2:", "byte 0x00", {std::string("action a\nframe 1\0\n", 18)});
  expect_refused("a1.action:1:", "byte 0x1b", {"\x1b[31maction a\n"});
  expect_refused("a1.action:4:", "a second angle of joint 'head_yaw'",
                 {"action a\nframe 1\n head_yaw 1\n head_yaw 2\n"});
  expect_refused("a1.action:3:", "no angle", {"action a\nframe 1\n head_yaw nan\n"});
  expect_refused("a1.action:1:", "before the action's name", {"frame 1\n"});
  expect_refused("a1.action:4:", "no frame 'x'",
                 {"action a\nframe 1\n head_yaw 1\n repeat 2 from x\n"});
  expect_refused("a1.action:4:", "no action 'x'", {"action a\nframe 1\n head_yaw 1\nlink x\n"});
  expect_refused("a1.action:2:", "does not reach", {"action a\nframe 1\n body z 0.3\n"});
  expect_refused("a2.action:1:", "is in a1.action too",
                 {"action a\nframe 1\n head_yaw 1\n", "action a\nframe 1\n head_yaw 1\n"});
}

TEST(ActionText, LinksThatNeverEndAreRefused) {
  expect_refused(
      "a1.action:4:", "never ends",
      {"action a\nframe 1\n head_yaw 1\nlink b\n", "action b\nframe 1\n head_yaw 1\nlink a\n"});
  EXPECT_EQ(
      refusal({"action a\nframe 1\n head_yaw 1\nlink b\n", "action b\nframe 1\n head_yaw 1\n"}),
      "");
}

TEST(ActionText, RubbishIsRefusedAndNeverCrashes) {
  std::uint32_t random = 1;
  const std::string good = kAll;
  for (int i = 0; i < 2000; ++i) {
    std::string text = good;
    for (int k = 0; k < 4; ++k) {
      random = random * 1664525U + 1013904223U;
      text[(random >> 8) % text.size()] = static_cast<char>(random >> 24);
    }
    try {
      parse_document("rubbish.action", text);
    } catch (const model::LoadError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, 14), "rubbish.action");
    }
  }
}

TEST(ActionLibrary, IsWhatTheCoreTakesAndTheSameEveryTime) {
  const std::vector<std::string> texts = {"action b\nframe 1\n head_yaw 10\n",
                                          "action a\nframe 0.5\n l_elbow -20\n"};
  const CompiledActions made = generic21().make(texts);
  const Library library = made.library();
  ASSERT_EQ(library.count(), 2) << "check_library() takes it";
  EXPECT_STREQ(library.action(1).name, "a") << "by name, in whatever order files come";
  EXPECT_EQ(made.words, generic21().make({texts[1], texts[0]}).words);
  const Frame& frame = library.frame(library.action(2).first);
  EXPECT_EQ(frame.goal_tenth_mrad[0], 1745) << "10 degrees";
}

TEST(ActionLibrary, RefusesToMoveAFollowerElsewhereThanItsMotorDoes) {
  const Params params = verp::test::with_coupled_hips(generic21().params, -1);
  const auto refused = [&](const std::string& text) -> std::string {
    try {
      (void)make_library(params, {parse_document("a.action", text)});
      return "";
    } catch (const model::LoadError& error) {
      return error.what();
    }
  };
  const std::string driver = params.joint[verp::test::kLeftLeg].name;
  const std::string follower = params.joint[verp::test::kFollower].name;
  const std::string both = "action a\nframe 1\n " + driver + " 10\n " + follower;
  EXPECT_EQ(refused("action a\nframe 1\n " + driver + " 10\n"), "");
  EXPECT_EQ(refused(both + " -10\n"), "");
  const std::string words = refused(both + " 10\n");
  EXPECT_NE(words.find("a.action:4"), std::string::npos) << words;
  EXPECT_NE(words.find("follows '" + driver + "'"), std::string::npos) << words;
  EXPECT_NE(refused("action a\nframe 1\n " + follower + " 10\n"), "");
  EXPECT_NE(refused("action a\nframe 1\n left_foot yaw 10\n"), "");
}

TEST(ActionLibrary, MirroredTwiceIsTheSame) {
  const CompiledActions made = generic21().make(
      {"action left\nframe 0.5\n l_shoulder_roll 60\n l_elbow -50\n head_yaw 30\n over left 0.7\n",
       "action right\nmirror left\n",
       "action by_hand\nframe 0.5\n r_shoulder_roll -60\n r_elbow -50\n head_yaw -30\n"
       " over right 0.7\n"});
  const Library library = made.library();
  const Frame& hand = library.frame(library.action(1).first);
  const Frame& right = library.frame(library.action(3).first);
  EXPECT_EQ(hand.joints, right.joints);
  for (int j = 0; j < generic21().params.joint_count; ++j) {
    EXPECT_NEAR(hand.goal_tenth_mrad[j], right.goal_tenth_mrad[j], 10)
        << generic21().params.joint[j].name;
  }
}

TEST(ActionLibrary, AJointThatTurnsBackRestsAndOneThatGoesOnPasses) {
  const CompiledActions made =
      generic21().make({"action a\nframe 0.5\n head_yaw 20\n head_pitch 10\nframe 0.5\n head_yaw "
                        "40\n head_pitch 0\n"});
  const Frame& first = made.library().frame(0);
  EXPECT_NEAR(first.speed_mrad_s[0], 698, 2) << "20 degrees in half a second, before and after";
  EXPECT_EQ(first.speed_mrad_s[1], 0);
}

}  // namespace
}  // namespace verp::action
