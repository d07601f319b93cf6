#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using WorldWalk = Program;
using nlohmann::json;

TEST_F(WorldWalk, APushedRunRepeatsReplaysAndSaysWhatWasDoneWhen) {
  const std::string words =
      "walk --for 3 --push '1: trunk 0,6,0 N for 0.1' --at '0: ground.friction=0.8' --json "
      "--record ";
  const Outcome first = verp(words + "a.mcap"), second = verp(words + "b.mcap");
  ASSERT_EQ(first.status, 0) << first.err;
  const json result = json::parse(first.out);
  EXPECT_EQ(result.at("digest"), json::parse(second.out).at("digest"));
  ASSERT_EQ(result.at("changes").size(), 2u);
  EXPECT_EQ(result.at("changes")[0].at("what"), "set ground.friction=0.8");
  EXPECT_EQ(result.at("changes")[0].at("tick"), 0);
  EXPECT_EQ(result.at("changes")[1].at("what"), "push trunk 0,6,0 N for 0.1 s");
  const Outcome replay = verp("replay a.mcap --json");
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(json::parse(replay.out).at("digest_replayed"), result.at("digest"));
  const json info = json::parse(verp("trace info a.mcap --json").out);
  ASSERT_EQ(info.at("changes").size(), 2u);
  EXPECT_EQ(info.at("changes")[1].at("tick"), result.at("changes")[1].at("tick"));

  const json plain = json::parse(verp("walk --for 3 --json").out);
  EXPECT_NE(plain.at("digest"), result.at("digest"));
  EXPECT_TRUE(plain.at("changes").empty());
}

TEST_F(WorldWalk, WrongPushesSettingsAndWorldsAreRefused) {
  expect_refused("walk --push '1: trnk 1,0,0 N for 1'", "did you mean trunk?");
  expect_refused("walk --push '1: trunk 1,0 N for 1'", "'1,0' is not fx,fy,fz");
  expect_refused("walk --push 'trunk 1,0,0 N for 1'", "no time before a colon");
  expect_refused("walk --at '1: trunk.mas_kg=1'", "did you mean trunk.mass_kg?");
  expect_refused("walk --at '1: trunk.mass_kg=-1'", "0.001 to 1000 kg");
  expect_refused("walk --at '1: trunk.mass_kg'", "that is not T: NAME=VALUE");
  expect_refused("walk --for 5 --at '6: trunk.mass_kg=1'", "raise --for");
  expect_refused("walk --world nowhere", "there is no world of this name");
  expect_refused("walk --at-pose 1,2", "is not X,Y,YAW");
}

TEST_F(WorldWalk, AWorldHasItsFloorItsBallAndItsQuantities) {
  const json flat = json::parse(verp("walk --world flat --for 3 --json").out);
  const json none = json::parse(verp("walk --for 3 --json").out);
  EXPECT_EQ(flat.at("digest"), none.at("digest")) << "the same floor";
  const Outcome pitch = verp("walk --world pitch --for 5 --json");
  ASSERT_EQ(pitch.status, 0) << pitch.err;
  const json ball = json::parse(pitch.out).at("objects").at(0);
  EXPECT_EQ(ball.at("name"), "ball");
  EXPECT_GT(ball.at("position_m")[0].get<double>(), 0.52) << "kicked";
  EXPECT_EQ(verp("check demo").status, 0);
  const Outcome list = verp("walk --world pitch --list-quantities --json");
  EXPECT_NE(list.out.find("\"ball.mass_kg\""), std::string::npos);
}

}  // namespace
}  // namespace verp::tool::test
