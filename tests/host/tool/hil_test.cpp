#include <atomic>
#include <nlohmann/json.hpp>

#include "firmware/app/link_bus.hpp"
#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/tool/link_controller.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using verp::test::ControllerPort;
using verp::test::LinkController;

class Hil : public Program {
 protected:
  Params params() const {
    return model::make_params(model::load_robot(model::find_model("generic21")));
  }
  action::CompiledActions actions() const {
    const auto entity = model::load_robot(model::find_model("generic21"));
    return action::make_library(params(), action::read_folder(action::folder_of(entity.file)));
  }
  std::string place(const std::string& name) const { return (folder_ / name).string(); }
  std::string sockets() const {
    return "--link unix-listen:" + place("bus") + " --operator unix-listen:" + place("orders");
  }
  Outcome hil(const std::string& arguments) const { return verp("hil " + arguments, "hil"); }

  json here(const std::string& arguments) const {
    const Outcome walk = verp("walk --json " + arguments, "walk");
    EXPECT_EQ(walk.status, 0) << walk.err;
    return json::parse(walk.out);
  }
};

void expect_same(const Outcome& outcome, const json& expected) {
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  for (const char* key : {"digest", "ticks", "duration_s", "distance_m", "zmp_bias_mean_mm"}) {
    EXPECT_EQ(result.at(key), expected.at(key)) << key;
  }
  EXPECT_EQ(result.at("compared_ticks"), expected.at("ticks"));
  EXPECT_GT(result.at("ticks_per_s").get<double>(), 0);
}

TEST_F(Hil, WalksWithTheBitsOfSoftwareInTheLoopOnEveryKindOfLink) {
  const json expected = here("--for 3");
  const std::string port = std::to_string(20000 + ::getpid() % 20000);
  const struct {
    std::string twin, controller;
  } links[] = {{"pty:" + place("pty"), "serial:" + place("pty") + "@2000000"},
               {"tcp-listen:" + port, "tcp:127.0.0.1:" + port},
               {"unix-listen:" + place("bus"), "unix:" + place("bus")}};
  for (const auto& link : links) {
    LinkController controller(params(), link.controller, "serial:" + place("orders") + "@1000000");
    const Outcome outcome = hil("--for 3 --json --record hil.mcap --link " + link.twin +
                                " --operator pty:" + place("orders"));
    controller.join();
    EXPECT_EQ(controller.verdict(), lockstep::Verdict::kAccepted);
    expect_same(outcome, expected);
    const Outcome replay = verp("replay hil.mcap --json", "replay");
    EXPECT_EQ(replay.status, 0) << replay.err;
    EXPECT_EQ(json::parse(replay.out).at("digest_replayed"), expected.at("digest"));
  }
}

TEST_F(Hil, LosesNoBitOnABadCable) {
  const json expected = here("--for 3");
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"),
                            [](ControllerPort& port) {
                              port.flips_per_million = 300;
                              port.cut_every = 400;
                            });
  const Outcome outcome = hil("--for 3 --json " + sockets());
  controller.join();
  expect_same(outcome, expected);
  EXPECT_GT(controller.spoilt(), 10u);
  EXPECT_GT(controller.cuts(), 1);
  EXPECT_GT(json::parse(outcome.out).at("link").at("repeats").get<int>(), 10);
  EXPECT_NE(outcome.err.find("the link is lost"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("the link is back"), std::string::npos) << outcome.err;
}

// Servos stay as they were. The run reports the reset; its trace ends with the first start.
TEST_F(Hil, GoesOnServingAControllerThatWasReset) {
  constexpr std::uint32_t kReset = 250;  // the robot stands
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"), {},
                            kReset);
  const Outcome outcome = hil("--for 3 --json --record hil.mcap " + sockets());
  controller.join();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("controller_resets"), 1);
  EXPECT_GT(result.at("ticks").get<std::uint32_t>(), kReset + 400) << "it had to stand up again";
  EXPECT_GE(result.at("compared_ticks").get<int>() + 2, result.at("ticks").get<int>());
  EXPECT_GT(result.at("distance_m").get<double>(), 0.1) << "it walked then";
  EXPECT_NE(outcome.err.find("the controller began anew at"), std::string::npos) << outcome.err;
  const Outcome replay = verp("replay hil.mcap --json", "replay");
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_NEAR(json::parse(replay.out).at("ticks").get<int>(), static_cast<int>(kReset), 2);
}

// A fall is the twin's result, not a failure of the link.
TEST_F(Hil, TellsWhatBecameOfARobotWhoseControllerWasResetInMidWalk) {
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"), {}, 600);
  const Outcome outcome = hil("--for 3 --json " + sockets());
  controller.join();
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("controller_resets"), 1);
  EXPECT_EQ(outcome.status, result.at("fallen").get<bool>() ? 1 : 0) << outcome.err;
  EXPECT_GT(result.at("ticks").get<int>(), 600) << "it was served on";
  EXPECT_EQ(controller.verdict(), lockstep::Verdict::kAccepted);
}

TEST_F(Hil, RefusesAControllerOfAnotherRobotByName) {
  Params other = params();
  other.joint[3].mass_kg *= 2;
  LinkController controller(other, "unix:" + place("bus"), "unix:" + place("orders"));
  const Outcome outcome = hil("--for 3 --json " + sockets());
  controller.join();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(controller.verdict(), lockstep::Verdict::kOtherRobot);
  EXPECT_NE(outcome.err.find("Params are not those of generic21"), std::string::npos)
      << outcome.err;
}

TEST_F(Hil, KeepsTheTraceWhenInterrupted) {
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"));
  const Outcome outcome = shell("timeout --preserve-status -s INT 6 " + std::string(VERP_PROGRAM) +
                                " hil --for 600 --json --record cut.mcap " + sockets());
  controller.join();
  EXPECT_EQ(outcome.status, 130);
  const json result = json::parse(outcome.out);
  EXPECT_TRUE(result.at("interrupted"));
  EXPECT_GT(result.at("ticks").get<int>(), 0);
  const Outcome info = verp("trace info cut.mcap --json", "info");
  EXPECT_EQ(json::parse(info.out).at("ticks"), result.at("ticks"));
}

// It is a failure if no client came or a walk is cut short.
TEST_F(Hil, CtrlCEndsWhatServedSomebodyInOrder) {
  const std::string twin = std::string(VERP_PROGRAM) + " hil --json --link unix-listen:bus";
  const std::string ready = "until grep -q 'waits for a controller' err; do sleep 0.05; done; ";
  const std::string end = "kill -INT $twin; wait $twin";
  const Outcome served = shell(twin + " 2>err & twin=$!; " + ready + VERP_PROGRAM +
                               " bus ping --id 1 --link unix:bus >ping; " + end);
  EXPECT_EQ(served.status, 0) << slurp(folder_ / "err") << slurp(folder_ / "ping");
  EXPECT_TRUE(json::parse(served.out).at("interrupted"));
  EXPECT_TRUE(json::parse(served.out).at("met"));
  fs::remove(folder_ / "err");
  const Outcome alone = shell(twin + " 2>err & twin=$!; " + ready + end);
  EXPECT_EQ(alone.status, 130);
  EXPECT_FALSE(json::parse(alone.out).at("met"));
  EXPECT_NE(slurp(folder_ / "err").find("before anybody came"), std::string::npos);
}

// The twin must not load the computer.
TEST_F(Hil, MeetsALinkThatIsCutAtOnceSomeTensOfTimesASecond) {
  std::atomic<bool> over = false;
  std::thread other([&] {
    const link::Endpoint endpoint = link::parse_endpoint("unix-listen:" + place("bus"));
    while (!over) {
      link::Link port(endpoint);
      while (!over && !port.wait_connected(1000)) {
      }
      std::ofstream(folder_ / "taken") << '\n';
    }
  });
  // For three seconds, however long the start takes.
  const Outcome outcome = shell("sleep 0.3; " + std::string(VERP_PROGRAM) +
                                " hil --lockstep --json --link unix:" + place("bus") +
                                " & twin=$!; until [ -e taken ]; do sleep 0.05; done; sleep 3; "
                                "kill -INT $twin; wait $twin");
  over = true;
  other.join();
  const int losses = json::parse(outcome.out).at("link").at("losses").get<int>();
  EXPECT_GT(losses, 3) << outcome.err;
  EXPECT_LT(losses, 3 * 30) << outcome.err;
}

std::string story_of(const json& result) {
  std::string all;
  for (const json& each : result.at("fall_story")) all += each.at("what").get<std::string>() + "; ";
  return all;
}

TEST_F(Hil, ARobotThatIsPushedOverGetsUpByTheControllersActions) {
  const std::string words = "--for 3 --json --get-up --push '1: trunk -60,0,0 N for 0.15'";
  const json expected = here(words);
  ASSERT_EQ(expected.at("get_ups"), 1);
  const action::CompiledActions made = actions();
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"), {}, 0,
                            made.library());
  const Outcome outcome = hil(words + " --record hil.mcap " + sockets());
  controller.join();
  expect_same(outcome, expected);
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("get_ups"), 1);
  EXPECT_EQ(result.at("changes").size(), 1u);
  EXPECT_EQ(result.at("fall_story"), expected.at("fall_story"));
  EXPECT_EQ(story_of(result),
            "falls, limbs in and soft; lies on its back; gets up, try 1 of 3; stands again; ");
  EXPECT_NE(outcome.err.find("s: gets up, try 1 of 3\n"), std::string::npos) << outcome.err;
  const Outcome replay = verp("replay hil.mcap --json", "replay");
  EXPECT_EQ(replay.status, 0) << replay.err;
}

TEST_F(Hil, ARobotThatLiesGetsUpFirst) {
  const action::CompiledActions made = actions();
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"), {}, 0,
                            made.library());
  const Outcome outcome = hil("--for 3 --json --start lying:back " + sockets());
  controller.join();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(story_of(result), "lies on its back; gets up, try 1 of 3; stands again; ");
  EXPECT_EQ(result.at("falls"), 0);
}

TEST_F(Hil, AControllerWithoutActionsIsToldThatItCannotGetUp) {
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"));
  const Outcome outcome = hil("--for 3 --json --get-up " + sockets());
  controller.join();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("has no actions, so it cannot get up"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("leave out --get-up"), std::string::npos) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out).at("ticks"), 0);
}

TEST_F(Hil, AControllerWithOtherActionsIsRefused) {
  const action::CompiledActions made =
      action::make_library(params(), {actions().documents.front()});
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("orders"), {}, 0,
                            made.library());
  const Outcome outcome = hil("--for 3 --json --get-up " + sockets());
  controller.join();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("has 1 actions and this PC's robot"), std::string::npos)
      << outcome.err;
}

TEST_F(Hil, SaysWhenTheOperatorsPortIsSilent) {
  LinkController controller(params(), "unix:" + place("bus"), "unix:" + place("elsewhere"));
  const Outcome outcome = hil("--for 3 --json " + sockets());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("device 200"), std::string::npos) << outcome.err;
}

// In wall-clock time, which begins with torque.
TEST_F(Hil, ServesAStockMasterInRealTime) {
  Outcome outcome;
  std::thread twin([&] { outcome = hil("--for 3 --json --link unix-listen:" + place("bus")); });
  ControllerPort port("unix:" + place("bus"));
  const link::SystemClock clock;
  app::LinkBus master(port, clock);
  const std::uint8_t id = params().joint[0].servo_id;
  std::uint8_t frame[16], reply[64];
  int answers = 0;
  const auto ask = [&](std::size_t size) {
    if (master.send(frame, size) && master.poll(reply, sizeof reply, 50'000) > 0) ++answers;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  };
  const auto look_for = [&](std::uint64_t time_us) {
    const int before = answers;
    for (std::uint64_t end_us = 0; end_us == 0 || clock.now_us() < end_us;) {
      ask(dxl::encode_ping(frame, sizeof frame, id));
      ask(dxl::encode_read(frame, sizeof frame, id, dxl::address::kPresentPosition, 4));
      if (end_us == 0 && answers > before) end_us = clock.now_us() + time_us;
    }
    return answers - before;
  };
  EXPECT_GT(look_for(3'500'000), 20) << "longer than it would have served";
  const std::uint8_t on = 1;
  ask(dxl::encode_write(frame, sizeof frame, id, dxl::address::kTorqueEnable, &on, 1));
  EXPECT_GT(look_for(2'000'000), 20);
  twin.join();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("pace"), "real time");
  EXPECT_NEAR(result.at("simulated_s").get<double>(), 3, 0.2);
  EXPECT_FALSE(result.at("fallen"));
}

TEST_F(Hil, RefusesWhatCannotBe) {
  expect_refused("hil", "--link");
  expect_refused("hil --link nonsense", "nonsense");
  expect_refused("hil --link pty: --operator pty: --realtime", "lockstep");
  for (const char* word :
       {"--record a.mcap", "--record-state", "--report a", "--step 0.02", "--velocity 0.1,0,0"}) {
    expect_refused(std::string("hil --link pty: ") + word, "--operator");
  }
}

}  // namespace
}  // namespace verp::tool::test
