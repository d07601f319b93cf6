#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "host/os/link/can_claim.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/can/can_world.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;

class RunOnCan : public Program {
 protected:
  Outcome beside_twin(const std::string& command) const {
    const std::string program = VERP_PROGRAM;
    // Deletes an earlier twin's output, which says the same.
    return shell("rm -f twin.err; " + program +
                 " hil generic21 --bus can --realtime --link can:vcan0 --for 600 --json "
                 ">twin.out 2>twin.err & twin=$!; "
                 "until grep -qs 'twin waits' twin.err; do sleep 0.05; done; ( " +
                 command + " ); status=$?; kill -INT $twin; wait $twin; exit $status");
  }
  Outcome bus_beside_twin(const std::string& arguments) const {
    return beside_twin(std::string(VERP_PROGRAM) + " bus " + arguments + " --link can:vcan0");
  }
  static Params params() {
    return model::make_params(model::load_robot(model::find_model("generic21"), "can"));
  }
};

// On a busy core `verp run` refuses with status 3, or the robot holds or falls, status 1: repeat.
TEST_F(RunOnCan, DrivesTheRobotAndLetsItGo) {
  const std::string run = std::string(VERP_PROGRAM) +
                          " run generic21 --bus can --link can:vcan0 --yes --json "
                          "--period 20 --for 3 --record run.mcap";
  const Outcome outcome = beside_twin("for attempt in 1 2 3 4 5; do " + run +
                                      " >run.json; status=$?; [ $status = 0 ] && break; sleep 3; "
                                      "done; cat run.json; exit $status");
  const json result = json::parse(outcome.out);
  ASSERT_TRUE(result.contains("failure")) << "refused: " << outcome.out << outcome.err;
  const std::string failure = result.at("failure");
  ASSERT_EQ(outcome.status, failure.empty() ? 0 : 1) << outcome.err;
  EXPECT_TRUE(result.at("let_go")) << outcome.err;
  EXPECT_GT(result.at("ticks"), 100);
  EXPECT_NE(outcome.err.find("relaxed to rising"), std::string::npos) << outcome.err;
  // More skipped periods mean a wrong clock.
  EXPECT_LT(result.at("deadlines").at("skipped_periods"), 3000);
  const bool undisturbed =
      result.at("deadlines").at("skipped_periods") == 0 && result.at("bus").at("timeouts") == 0;
  EXPECT_EQ(result.at("bus").at("overruns"), 0);
  if (undisturbed) {
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("standing to walking"), std::string::npos) << outcome.err;
    EXPECT_GT(result.at("walked_s"), 2);
  }
  const Outcome replay = verp("replay run.mcap", "replay");
  EXPECT_EQ(replay.status, 0) << replay.err;
}

// Ctrl-C ends the questions whether drives let go; the report says what is unknown.
TEST_F(RunOnCan, AnInterruptEndsTheQuestionsToSilentDrives) {
  const std::string run = std::string(VERP_PROGRAM) +
                          " run generic21 --bus can --link can:vcan0 --yes --json --period 20 "
                          "--for 60 >run.out 2>run.err";
  // Status 3 without a question means a busy PC: try again.
  const Outcome outcome = beside_twin(
      "for attempt in 1 2 3 4 5; do " + run +
      " & run=$!; while kill -0 $run && ! grep -q 'relaxed to rising' run.err; do sleep 0.1; done; "
      "kill -0 $run && break; sleep 3; done; "
      "kill -STOP $twin; candump -L vcan0,600:780 >asked & log=$!; "
      "while kill -0 $run && ! grep -q '#40416000' asked; do sleep 0.05; done; kill -INT $run; "
      "wait $run; status=$?; kill $log; kill -CONT $twin; exit $status");
  const std::string errors = slurp(folder_ / "run.err");
  EXPECT_EQ(outcome.status, 3) << errors;
  EXPECT_NE(errors.find("21 servos did not say that they let go"), std::string::npos) << errors;
  EXPECT_EQ(json::parse(slurp(folder_ / "run.out")).at("let_go"), false);
  std::istringstream asked(slurp(folder_ / "asked"));
  std::set<std::string> drives;
  for (std::string line; std::getline(asked, line);) {
    const std::size_t at = line.find("#40416000");
    if (at != std::string::npos) drives.insert(line.substr(at - 3, 3));
  }
  EXPECT_GE(drives.size(), 1u);
  EXPECT_LT(drives.size(), 21u) << "all of them: the press was not heard";
}

TEST_F(RunOnCan, SaysThatNobodyAnswers) {
  const Outcome outcome = verp("run generic21 --bus can --link can:vcan0 --yes");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("no drive of generic21 answers"), std::string::npos) << outcome.err;
  EXPECT_EQ(verp("bus ping --id 3 --link can:vcan0").status, 3);
}

// Its bring-up would reset the first one's nodes.
TEST_F(RunOnCan, RefusesToBeTheSecondOfThisPcBeforeItSendsAnything) {
  verp::test::OwnVcan bus;
  link::CanPort listener(bus.endpoint());
  const link::CanClaim first(bus.name, "controller", "`verp run`");
  const Outcome outcome = verp("run generic21 --bus can --link can:vcan7 --yes");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("can:vcan7: another `verp run` has this interface"), std::string::npos)
      << outcome.err;
  verp::test::settle(listener);
}

TEST_F(RunOnCan, RefusesToBeTheSecondOnABusBeforeItSendsAnything) {
  verp::test::OwnVcan bus;
  for (const std::string id : {"0x000", "0x080", "0x77F", "0x1FF", "0x605"}) {
    std::atomic<bool> over = false;
    bool alone = true;
    std::thread other([&] {
      link::CanPort port(bus.endpoint());
      CanFrame heard;
      while (!over) {
        port.send(verp::test::frame_of(static_cast<std::uint32_t>(std::stoul(id, nullptr, 16))));
        alone = alone && !port.await(heard, 100'000);
      }
    });
    const Outcome outcome = verp("run generic21 --bus can --link can:vcan7 --yes");
    over = true;
    other.join();
    EXPECT_EQ(outcome.status, 3) << id;
    EXPECT_NE(outcome.err.find("can:vcan7: another controller or tool commands nodes on this bus"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find(id + " was heard"), std::string::npos) << outcome.err;
    EXPECT_TRUE(alone) << id;
  }
}

// Both would answer.
TEST_F(RunOnCan, ServesNodesOnceOnABus) {
  verp::test::OwnVcan bus;
  const std::string hil = "hil generic21 --bus can --realtime --link can:vcan7 --for 600";
  {
    const link::CanClaim first(bus.name, "nodes", "`verp hil`");
    const Outcome outcome = verp(hil);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("another `verp hil` has this interface"), std::string::npos)
        << outcome.err;
  }
  for (const std::string& signal : {std::string("KILL"), std::string("INT")}) {
    const std::string said = signal + ".err";  // earlier files name a twin, too
    const Outcome outcome =
        shell(std::string(VERP_PROGRAM) + " " + hil + " 2>" + said +
              " & twin=$!; until grep -q 'twin waits' " + said +
              " || ! kill -0 $twin; do sleep 0.05; done; kill -" + signal + " $twin; wait $twin");
    EXPECT_NE(slurp(folder_ / said).find("twin waits"), std::string::npos) << outcome.err;
  }
}

TEST_F(RunOnCan, ATwinThatIsHeldUpSkipsAndSaysSoAtOnce) {
  verp::test::OwnVcan bus;
  std::atomic<bool> over = false;
  // A twin with many waiting frames may catch up.
  std::thread master([&] {
    link::CanPort port(bus.endpoint());
    while (!over) {
      port.send(verp::test::frame_of(0x080));
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
  });
  const Outcome outcome =
      shell(std::string(VERP_PROGRAM) +
            " hil generic21 --bus can --realtime --link can:vcan7 --for 600 --json 2>twin.err & "
            "twin=$!; until grep -q 'in real time' twin.err; do sleep 0.05; done; "
            "for i in 1 2 3 4 5 6 7 8; do kill -STOP $twin; sleep 0.4; kill -CONT $twin; "
            "sleep 0.02; done; cp twin.err before.err; kill -INT $twin; wait $twin");
  over = true;
  master.join();
  const json result = json::parse(outcome.out);
  const std::string failure = result.at("failure");
  EXPECT_EQ(outcome.status, failure.empty() ? 0 : 130) << failure << '\n' << outcome.err;
  const std::string at_once = slurp(folder_ / "before.err");
  EXPECT_NE(at_once.find("is skipped"), std::string::npos) << at_once;
  EXPECT_NE(at_once.find("without real-time priority"), std::string::npos) << at_once;
  EXPECT_GT(result.at("link").at("skipped_us"), 1'000'000) << outcome.out;
}

TEST_F(RunOnCan, FindsEveryNode) {
  const Outcome outcome = bus_beside_twin("scan --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json nodes = json::parse(outcome.out).at("nodes");
  const Params robot = params();
  std::size_t expected = robot.joint_count + (robot.imu.device_id != 0 ? 1u : 0u);
  for (const std::uint8_t foot : robot.feet.device_id) expected += foot != 0 ? 1 : 0;
  EXPECT_EQ(nodes.size(), expected);
  for (const json& each : nodes) {
    if (each.at("id") == robot.joint[0].servo_id) {
      EXPECT_EQ(each.at("device_type"), 0x20192);
    }
    if (each.at("id") == robot.imu.device_id) {
      EXPECT_EQ(each.at("product"), 0x7601);
    }
  }
}

TEST_F(RunOnCan, ReadsAndWritesObjects) {
  const std::string id = " --id " + std::to_string(params().joint[0].servo_id);
  const std::string program = std::string(VERP_PROGRAM) + " bus ";
  const std::string link = " --link can:vcan0" + id;
  const Outcome outcome = beside_twin(program + "write --object 6065:0 1234" + link + " && " +
                                      program + "read --object 6065:0" + link);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out == "1234\n" || outcome.out == "0x000004D2\n") << outcome.out;
  const Outcome refused = bus_beside_twin("read --object 2FFF:0" + id);
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("no such object (0x06020000)"), std::string::npos) << refused.err;
}

// A drive has as many COB-IDs as PDOs.
TEST_F(RunOnCan, LosesNoObjectWhoseNameAnotherHasToo) {
  const std::string to = " --link can:vcan0 --id " + std::to_string(params().joint[0].servo_id);
  const std::string program = std::string(VERP_PROGRAM) + " bus ";
  const Outcome outcome =
      beside_twin(program + "read" + to + " >lines && " + program + "read --json" + to + " && ! " +
                  program + "write --register COB-ID 0x80000201" + to);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json objects = json::parse(outcome.out).at("objects");
  const std::string lines = slurp(folder_ / "lines");
  EXPECT_EQ(static_cast<std::ptrdiff_t>(objects.size()),
            std::count(lines.begin(), lines.end(), '\n'));
  for (const char* at : {"1400:1", "1401:1", "1800:1"}) {
    EXPECT_EQ(objects.at(at).at("name"), "COB-ID") << at;
  }
  EXPECT_NE(objects.at("1400:1").at("value"), objects.at("1401:1").at("value"));
  EXPECT_NE(outcome.err.find("1400:1, 1401:1"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("--object"), std::string::npos) << outcome.err;
}

TEST_F(RunOnCan, ShowsFieldsInHexAndSmallIntegersWithTheirSign) {
  const std::string to = " --link can:vcan0 --id " + std::to_string(params().joint[0].servo_id);
  const std::string program = std::string(VERP_PROGRAM) + " bus ";
  const std::string read = program + "read" + to + " --object ", write = program + "write" + to;
  const Outcome outcome =
      beside_twin(read + "1005:0 && " + read + "1A00:1 && " + write + " --object 60C2:2 -3 && " +
                  read + "60C2:2 && " + read + "60C2:2 --json && ! " + write +
                  " --object 60C2:2 -129 && ! " + read + "1A00:1F");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = "0x00000080\n0x60410010\n-3\n";  // SYNC; statusword, 16 bits
  ASSERT_EQ(outcome.out.substr(0, text.size()), text);
  EXPECT_EQ(json::parse(outcome.out.substr(text.size())).at("objects").at("60C2:2").at("value"),
            -3);
  EXPECT_NE(outcome.err.find("-128 to 127"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("the read of 1A00:1F"), std::string::npos) << outcome.err;
}

TEST_F(RunOnCan, MeasuresRoundTrips) {
  const Outcome outcome =
      bus_beside_twin("bench --for 0.5 --json --id " + std::to_string(params().joint[0].servo_id));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(json::parse(outcome.out).at("round_trips"), 10);
}

TEST_F(RunOnCan, RefusesWhatCanHasNot) {
  expect_refused("bus read --link can:vcan0 --id 3 --address 12", "--object INDEX:SUBINDEX");
  expect_refused("bus bench --link can:vcan0 --id 3 --address 12", "on CAN 1000:0 is read");
  expect_refused("bus bench --link can:vcan0 --id 3 --size 2", "on CAN 1000:0 is read");
  expect_refused("bus read --link can:vcan0 --id 3 --object 6064:0 --size 2", "--size");
  expect_refused("bus scan --link can:vcan0 --each", "every id is asked anyway");
  expect_refused("bus ping --link can:vcan0 --id 128", "no node id");
  expect_refused("bus read --link can:vcan0 --id 3 --object 6064:xyz", "is no address");
  expect_refused("bus read --link pty:x --id 3 --object 6064:0", "of CAN's nodes");
  const Outcome other = verp("bus scan --link can:lo");
  EXPECT_EQ(other.status, 3);
  EXPECT_NE(other.err.find("is no CAN interface; CAN interfaces here: vcan0"), std::string::npos)
      << other.err;
  expect_refused("run generic21 --link can:vcan0", "choose another of its buses with --bus");
}

}  // namespace
}  // namespace verp::tool::test
