#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "host/trace/record/ros_radio.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;

class WalkRadio : public Program {
 protected:
  struct Talk {
    Outcome world, leader, follower;
  };
  Talk talk(const std::string& words) const {
    Talk talk;
    const std::string example = "timeout 100 python3 " VERP_RADIO_EXAMPLE " ";
    std::thread leader([&] { talk.leader = shell(example + "a.sock leader 3", "leader"); });
    std::thread follower([&] { talk.follower = shell(example + "b.sock follower 3", "follower"); });
    talk.world = verp(
        "walk --json --for 3 --physics-step 2 --robot a=ext:unix-listen:a.sock --robot "
        "b=ext:unix-listen:b.sock " +
            words,
        "world");
    leader.join();
    follower.join();
    fs::remove(folder_ / "a.sock");
    fs::remove(folder_ / "b.sock");
    return talk;
  }

  std::map<std::string, int> kept(const std::string& file) const {
    const std::string bytes = slurp(folder_ / file);
    const record::mcap::WholeFile trace = record::mcap::parse(bytes);
    std::map<std::string, int> events;
    std::uint16_t channel = 0;
    if (trace.find_channel("/radio", channel) == nullptr) return events;
    for (const record::mcap::Message& each : trace.messages) {
      if (each.channel != channel) continue;
      const auto radio = record::ros::read_radio(each.data);
      if (radio)
        ++events[radio->event + " " + std::to_string(radio->from) + " " +
                 std::to_string(radio->to)];
    }
    return events;
  }
};

TEST_F(WalkRadio, ProgramsOutsideHearEachOtherAsTheAirHasIt) {
  const Talk first = talk("--robot c=generic21 --record run.mcap --radio 'loss=0.3 fade=0'");
  ASSERT_EQ(first.world.status, 0) << first.world.err;
  EXPECT_EQ(first.leader.status, 0) << first.leader.err;
  EXPECT_EQ(first.follower.status, 0) << first.follower.err;
  const json radio = json::parse(first.world.out).at("radio");
  EXPECT_EQ(radio.at("robots"), json({"a", "b", "c"})) << "numbers in the order of the words";
  EXPECT_EQ(radio.at("sent"), 30);
  const int heard = radio.at("heard"), lost = radio.at("lost");
  EXPECT_EQ(heard + lost, 60) << radio;
  EXPECT_NEAR(lost, 18, 9) << radio;
  // As the first trace, c's also has the events of robots driven from outside.
  std::map<std::string, int> events = kept("run.mcap");
  EXPECT_EQ(events.at("said 0 -1"), 30);
  EXPECT_EQ(events.at("heard 0 1") + events.at("heard 0 2"), heard);
  const auto lines = [](const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') - 1;
  };
  EXPECT_EQ(lines(first.follower.out), events.at("heard 0 1")) << first.follower.out;
  const Outcome alone =
      verp("walk --json --for 3 --physics-step 2 --seed 3 --at-pose -0.8,0,0", "alone");
  EXPECT_EQ(json::parse(first.world.out).at("digest"), json::parse(alone.out).at("digest"));
  const Talk second = talk("--radio 'loss=0.3 fade=0'");
  ASSERT_EQ(second.world.status, 0) << second.world.err;
  EXPECT_EQ(second.follower.out, first.follower.out);
}

TEST_F(WalkRadio, BeyondItsRangeNothingIsHeard) {
  const Talk far = talk("--radio range_m=0.5");
  EXPECT_EQ(far.world.status, 0) << far.world.err;
  EXPECT_EQ(far.follower.status, 1) << far.follower.out;
  EXPECT_EQ(json::parse(far.world.out).at("radio").at("too far"), 30);
}

TEST_F(WalkRadio, WhatCannotBeIsOneLineAndBadInput) {
  expect_refused("walk --robots 2 --robot r2=ext:pty:p --radio far=1", "range_m, loss");
  expect_refused("walk --robots 2 --robot r2=ext:pty:p --radio loss=2", "0 to 1");
  expect_refused("walk --radio loss=0.1", "nobody to talk to");
  expect_refused("walk --robots 2 --radio loss=0.1", "ext:LINK");
  expect_refused("walk --bus can --robots 2 --robot r2=ext:can:vcan9 --radio loss=0.1",
                 "speaks CAN");
}

}  // namespace
}  // namespace verp::tool::test
