#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

// `verp run` on a CAN interface as others there see it: a node that tells of its ticks.
namespace verp::tool::test {
namespace {

using nlohmann::json;

class WatchedRun : public Program {
 protected:
  /// `watch` beside `verp run` on vcan0, with the twin as its robot in real time; then the run is
  /// interrupted. As in RunOnCan one core is all of them, and a run may refuse it or end early: so
  /// there is another one until `watch` is done. The period is one that a core can keep.
  Outcome run_beside(const std::string& watch, const std::string& options = "") const {
    const std::string on_bus = " generic21 --bus can --json --link can:vcan0 ";
    return shell("verp=" VERP_PROGRAM "; watch() { " + watch +
                 "; touch watched; kill -INT $(cat run.pid); }; $verp hil" + on_bus +
                 "--realtime --for 600 >twin.out 2>twin.err & twin=$!; "
                 "until grep -q 'twin waits' twin.err; do sleep 0.05; done; watch & watcher=$!; "
                 "until [ -e watched ]; do $verp run" +
                 on_bus + "--yes --period 20 --for 60 " + options +
                 " >last.out & "
                 "echo $! >run.pid; wait $!; [ -e watched ] || sleep 3; done; "
                 "wait $watcher; kill -INT $twin; wait $twin");
  }
};

/// A script of this folder, in the shell.
std::string script(const std::string& words) {
  return "/usr/bin/python3 " VERP_SOURCE_DIR "/tests/can/" + words;
}

// Somebody polls the same node all the while, and nobody takes another's answer for its own.
TEST_F(WatchedRun, AnswersAPollerBesideOurOwnTools) {
  const Outcome outcome = run_beside(
      "until $verp bus ping --link can:vcan0 --id 127 >/dev/null 2>&1; do sleep 0.2; done; " +
      script("poller.py >poll.out & poller=$!; ") +
      "$verp shadow generic21 --period 20 --json --link can:vcan0 --for 1 --patience 60 "
      ">shadow.out 2>shadow.err & shadow=$!; good=0; "
      "for i in 1 2 3 4 5; do $verp bus read --link can:vcan0 --register model_information "
      "2>>read.err && good=$((good + 1)); done >read.out; echo $good >reads; wait $shadow; "
      "echo $? >shadow.status; kill $poller; wait $poller");
  EXPECT_EQ(slurp(folder_ / "shadow.status"), "0\n") << slurp(folder_ / "shadow.err");
  EXPECT_EQ(slurp(folder_ / "reads"), "5\n") << slurp(folder_ / "read.err") << outcome.err;
  const json polled = json::parse(slurp(folder_ / "poll.out"));
  EXPECT_GT(polled.at("good"), 20) << polled;
  EXPECT_EQ(polled.at("wrong"), 0) << polled;
}

// What host/can/masters.md shows.
TEST_F(WatchedRun, WalksAsAForeignMasterOrdersItsNode) {
  const Outcome outcome =
      run_beside("for i in 1 2 3 4 5 6; do " + script("order_walk.py vcan0 300 100 4 ") +
                     ">order.out 2>order.err && break; sleep 2; done",
                 "--take-orders");
  const json modes = json::parse(slurp(folder_ / "order.out")).at("modes");
  constexpr int kStanding = 2, kWalking = 3;
  const auto walks = std::find(modes.begin(), modes.end(), kWalking);
  ASSERT_NE(walks, modes.end()) << modes << slurp(folder_ / "order.err") << outcome.err;
  EXPECT_NE(std::find(walks, modes.end(), kStanding), modes.end()) << modes;
  const json run = json::parse(slurp(folder_ / "last.out"));
  EXPECT_GT(run.at("walked_s"), 2) << outcome.err;
  EXPECT_EQ(run.at("failure"), "") << run;
  EXPECT_TRUE(run.at("let_go")) << outcome.err;
}

// Whoever is on the bus sees what the PC's controller decides, and has no say in it: an order that
// nobody would obey is refused by name.
TEST_F(WatchedRun, TellsOfEachTickShowsItsRegistersAndRefusesOrders) {
  const Outcome outcome = run_beside(
      "$verp shadow generic21 --period 20 --json --link can:vcan0 --for 1 --patience 60 "
      ">shadow.out "
      "2>shadow.err;"
      " echo $? >shadow.status; "
      "$verp bus read --link can:vcan0 --register joint_velocity --json >read.out 2>read.err; "
      "echo $? >read.status; "
      "$verp bus write --link can:vcan0 --register request 0 2>write.err; echo $? >write.status");
  const json shadow = json::parse(slurp(folder_ / "shadow.out"));
  EXPECT_EQ(slurp(folder_ / "shadow.status"), "0\n")
      << slurp(folder_ / "shadow.err") << shadow << outcome.err;
  EXPECT_GE(shadow.at("compared_ticks"), 50) << outcome.err;
  EXPECT_EQ(shadow.at("differs"), false);
  EXPECT_EQ(slurp(folder_ / "read.status"), "0\n") << slurp(folder_ / "read.err");
  const json told = json::parse(slurp(folder_ / "read.out")).at("objects");
  EXPECT_EQ(told.size(), 32u) << "all of them by the array's name";
  EXPECT_TRUE(
      std::any_of(told.begin(), told.end(), [](const json& each) { return each.at("value") != 0; }))
      << "some joint moves: " << told;
  EXPECT_EQ(slurp(folder_ / "write.status"), "3\n");
  EXPECT_NE(slurp(folder_ / "write.err").find("under local control"), std::string::npos)
      << slurp(folder_ / "write.err");
  const json run = json::parse(slurp(folder_ / "last.out"));
  EXPECT_TRUE(run.at("let_go")) << outcome.err;
  EXPECT_EQ(run.at("bus").at("overruns"), 0);
}

}  // namespace
}  // namespace verp::tool::test
