#include <signal.h>

#include <chrono>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/os/link/link.hpp"
#include "host/os/process/child.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;

class Team : public Program {
 protected:
  process::Child controller(const std::string& link,
                            const std::vector<std::string>& more = {}) const {
    wait_for(link);
    return controller_now(link, more);
  }
  void wait_for(const std::string& link) const {
    for (int i = 0; i < 1500 && !fs::exists(folder_ / link); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  /// The file is there a moment before the world listens.
  static link::Link connect_to(const fs::path& socket) {
    const link::Endpoint end = link::parse_endpoint("unix:" + socket.string());
    for (int i = 0; i < 100; ++i) {
      try {
        return link::Link(end);
      } catch (const std::exception&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    }
    return link::Link(end);
  }
  process::Child controller_now(const std::string& link,
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {VERP_PROGRAM, "run",    "--lockstep", "--for",
                                      "3",          "--json", "--link",     "unix:" + link};
    words.insert(words.end(), more.begin(), more.end());
    return process::Child({.words = words,
                           .input = {},
                           .output = {.file = folder_ / (link + ".out")},
                           .folder = folder_});
  }

  Outcome walk_beside(const std::function<void()>& meanwhile, const std::string& words) const {
    Outcome outcome;
    std::thread world(
        [&] { outcome = verp("walk --json --for 3 --physics-step 2 " + words, "world"); });
    meanwhile();
    world.join();
    return outcome;
  }

  json first_difference(const std::string& trace, const std::string& other) const {
    return json::parse(verp("diff --json " + trace + " " + other, "diff").out).at("divergence");
  }
};

TEST_F(Team, EachWalksAsItDoesAloneAndLeavesATraceOfItsOwn) {
  const Outcome together = verp("walk --robots 3 --for 3 --physics-step 2 --json --record a.mcap");
  ASSERT_EQ(together.status, 0) << together.err;
  const json all = json::parse(together.out);
  EXPECT_EQ(all.at("digest"),
            json::parse(verp("walk --for 3 --physics-step 2 --json").out).at("digest"));
  ASSERT_EQ(all.at("others").size(), 2u);
  const json& third = all.at("others")[1];
  EXPECT_EQ(third.at("name"), "r3");
  const json alone =
      json::parse(verp("walk --for 3 --physics-step 2 --json --seed 3 --at-pose -0.8,0,0").out);
  EXPECT_EQ(third.at("digest"), alone.at("digest"))
      << "the third has the third seed, and its place";
  const Outcome replay = verp("replay a.r3.mcap --json");
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(json::parse(replay.out).at("digest_replayed"), third.at("digest"));
}

TEST_F(Team, AControllerInAnotherProcessMakesTheSameBits) {
  const Outcome own =
      verp("walk --seed 2 --at-pose 0,-0.8,0 --for 3 --physics-step 2 --json --record own.mcap");
  ASSERT_EQ(own.status, 0) << own.err;
  const std::pair<std::string, std::string> ends[] = {{"unix-listen:", "unix:"},
                                                      {"pty:", "serial:"}};
  for (const auto& [here, there] : ends) {
    fs::remove(folder_ / "b.end");
    const std::string client =
        there + (folder_ / "b.end").string() + (there == "serial:" ? "@2000000" : "");
    const Outcome world = walk_beside(
        [&] {
          wait_for("b.end");
          const Outcome run =
              verp("run --lockstep --for 3 --record b.mcap --link " + client, "run");
          EXPECT_EQ(run.status, 0) << run.err;
        },
        "--robot a=generic21 --robot b=ext:" + here + "b.end");
    ASSERT_EQ(world.status, 0) << world.err;
    const json other = json::parse(world.out).at("others")[0];
    EXPECT_EQ(other.at("controller"), here + "b.end");
    EXPECT_TRUE(other.at("digest").is_null()) << "its controller's, and not told here";
    EXPECT_GT(other.at("end_m")[0].get<double>(), 0.1) << "it walked";
    // Until the controller sits it down.
    const json first = first_difference("own.mcap", "b.mcap");
    EXPECT_EQ(first.at("stage"), "inputs") << first;
    EXPECT_GE(first.at("tick").get<int>() + 35, json::parse(own.out).at("ticks").get<int>())
        << first;
  }
}

TEST_F(Team, AControllerMayBeStartedBeforeItsWorld) {
  process::Child early = controller_now("c.sock");
  const auto said = [&] { return slurp(folder_ / "c.sock.out"); };
  while (said().find("waiting for the twin at unix:c.sock") == std::string::npos && !early.status())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Outcome world = walk_beside([&] { EXPECT_EQ(early.wait(), 0) << said(); },
                                    "--robot a=ext:unix-listen:c.sock");
  EXPECT_EQ(world.status, 0) << world.err;
}

TEST_F(Team, ALyingRobotGetsUpForAControllerThatMayLetIt) {
  const Outcome world = walk_beside(
      [&] {
        EXPECT_EQ(controller("c.sock", {"--get-up"}).wait(), 0) << slurp(folder_ / "c.sock.out");
      },
      "--robot a=ext:unix-listen:c.sock --start lying:back");
  EXPECT_EQ(world.status, 0) << world.err;
  const std::string said = slurp(folder_ / "c.sock.out");  // both streams
  ASSERT_NE(said.find('{'), std::string::npos) << said;
  const json run = json::parse(said.substr(said.find('{'), said.rfind('}') + 1 - said.find('{')));
  EXPECT_EQ(run.at("get_ups"), 1);
  EXPECT_EQ(run.at("falls"), 0);
  ASSERT_EQ(run.at("fall_story").size(), 2u) << said;
  EXPECT_EQ(run.at("fall_story")[0].at("what"), "lies on its back; gets up, try 1 of 3");
  EXPECT_EQ(run.at("fall_story")[1].at("what"), "stands again");
  EXPECT_NE(world.err.find("s: lies on its back\n"), std::string::npos) << world.err;
  EXPECT_GT(run.at("walked_s").get<double>(), 2);
}

TEST_F(Team, ALyingRobotStaysDownForAControllerThatMayNot) {
  walk_beside([&] { EXPECT_EQ(controller("c.sock").wait(), 1) << slurp(folder_ / "c.sock.out"); },
              "--robot a=ext:unix-listen:c.sock --start lying:back");
}

TEST_F(Team, OneThatLosesItsControllerStopsTheOthersOrGoesOnWithout) {
  for (const std::string option : {"", " --if-lost-go-on"}) {
    const Outcome world = walk_beside(
        [&] {
          process::Child child = controller("b.sock");
          while (slurp(folder_ / "world.err").find("has torque") == std::string::npos)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
          child.tell(SIGKILL);
        },
        "--robots 2 --robot r2=ext:unix-listen:b.sock --patience 0.5" + option);
    fs::remove(folder_ / "b.sock");
    EXPECT_EQ(world.status, 1) << world.err;
    const json all = json::parse(world.out);
    const std::string why = all.at("others")[0].at("failure");
    EXPECT_NE(why.find("kept the twin waiting for 0.5 s: its link is lost"), std::string::npos)
        << why;
    EXPECT_EQ(all.at("failure").get<std::string>().empty(), !option.empty()) << all.at("failure");
  }
}

// Only for connected controllers.
TEST_F(Team, WhomItWaitsForIsSaidAtOnceAndOnceMore) {
  process::Child world(
      {.words = {VERP_PROGRAM, "walk", "--json", "--patience", "0.3", "--robot",
                 "a=ext:unix-listen:a.sock", "--robot", "b=ext:unix-listen:b.sock"},
       .input = {},
       .output = {.file = folder_ / "world.err"},
       .folder = folder_});
  const auto said = [&] { return slurp(folder_ / "world.err"); };
  const std::string reminder = "a: no controller has announced lockstep on unix:a.sock in 0.3 s";
  while (said().find(reminder) == std::string::npos && !world.status())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  for (const char* robot : {"a", "b"}) {
    const std::string name = robot;
    const std::string line = name + ": the twin waits for a controller on unix:" + name + ".sock";
    EXPECT_NE(said().find(line), std::string::npos) << said();
  }
  EXPECT_FALSE(world.status()) << said();
  world.tell(SIGINT);
  EXPECT_EQ(world.wait(), 130) << said();
  EXPECT_EQ(said().find(reminder), said().rfind(reminder)) << "once: " << said();
}

TEST_F(Team, ASecondControllerOfOneRobotIsToldThatNobodyAnswersIt) {
  walk_beside(
      [&] {
        process::Child first = controller("b.sock");
        while (slurp(folder_ / "world.err").find("has torque") == std::string::npos)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
        first.tell(SIGSTOP);
        const Outcome second = verp("run --lockstep --for 3 --link unix:b.sock", "second");
        EXPECT_EQ(second.status, 3) << second.err;
        EXPECT_NE(second.err.find("serves no second one"), std::string::npos) << second.err;
        first.tell(SIGKILL);
      },
      "--patience 5 --robot b=ext:unix-listen:b.sock");
}

TEST_F(Team, WhoSaysAnythingButAGreetingIsTold) {
  process::Child world(
      {.words = {VERP_PROGRAM, "walk", "--patience", "0.3", "--robot", "a=ext:unix-listen:a.sock"},
       .input = {},
       .output = {.file = folder_ / "world.err"},
       .folder = folder_});
  wait_for("a.sock");
  link::Link client = connect_to(folder_ / "a.sock");
  const std::string words = "GET / HTTP/1.1\r\n\r\n";
  client.write(reinterpret_cast<const std::uint8_t*>(words.data()), words.size(), 100'000);
  const auto said = [&] { return slurp(folder_ / "world.err"); };
  while (said().find("in 0.3 s") == std::string::npos && !world.status())
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_NE(said().find("in 0.3 s (18 bytes came, no greeting among them)"), std::string::npos)
      << said();
  world.tell(SIGINT);
  EXPECT_EQ(world.wait(), 130) << said();
}

TEST_F(Team, WrongWordsAreRefused) {
  expect_refused("walk generic21 --robot op3", "two models, generic21 and op3");
  expect_refused("walk --robot nosuch --robot c=generic21", "nosuch has no name");
  expect_refused("walk op3 --robot c=generic21", "op3 has no name");
  expect_refused("walk --robot 'a b=op3' --robot c=generic21", "letters, digits");
  expect_refused("walk --robot a=", "is not NAME=MODEL");
  expect_refused("walk --robot a=ext:", "is not NAME=MODEL");
  expect_refused("walk --robot a=generic21,over:x", "is not NAME=MODEL");
  expect_refused("walk --robot a=generic21 --robot a=generic21", "there is a robot a already");
  expect_refused("walk --robot a=nope", "there is no robot of this name");
  expect_refused("walk --robot a=ext:bogus", "bogus");
  expect_refused("walk --robot a=ext:bogus", "robot a: ");
  expect_refused("walk --robot a=on:mps2_an386,ext:unix:x", "one controller");
  expect_refused("walk --robot a=generic21,ext:pty:x,on:mps2_an386", "one controller");
  expect_refused("walk --robots 2 --if-lost-go-on", "--if-lost-go-on is of robots that others");
  expect_refused("walk --patience 3", "--patience is of robots that others");
  expect_refused("walk --robots 17", "1 to 16");
  expect_refused("walk --robots 2 --at-pose r2=0,0,0", "robot 0 stands there already");
  expect_refused("walk --robots 16 --robot extra=generic21", "a world has room for 16");
  expect_refused("walk --robots 2 --on mps2_an386", "--robot NAME=on:mps2_an386");
  expect_refused("walk --robots 2 --seeds 1-4", "--seeds is of walks of one robot");
  expect_refused("walk --robots 2 --map push", "--map is of walks of one robot");
  expect_refused("walk --robots 2 --at-pose 1,0,0", "say whose it is");
  expect_refused("walk --robot a=ext:unix-listen:a.sock --record a.mcap", "record its own");
  expect_refused("run op3 --bus can --lockstep --link can:vcan0", "--");
}

}  // namespace
}  // namespace verp::tool::test
