#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;

class WatchedRun : public Program {
 protected:
  /// One core runs all, so runs may end early and repeat until `watch` is done.
  Outcome run_beside(const std::string& watch) const {
    const std::string on_bus = " generic21 --bus can --json --link can:vcan0 ";
    return shell("verp=" VERP_PROGRAM "; watch() { " + watch +
                 "; touch watched; kill -INT $(cat run.pid); }; $verp hil" + on_bus +
                 "--realtime --for 600 >twin.out 2>twin.err & twin=$!; "
                 "until grep -q 'twin waits' twin.err; do sleep 0.05; done; watch & watcher=$!; "
                 "until [ -e watched ]; do $verp run" +
                 on_bus +
                 "--yes --period 20 --for 60 >last.out & "
                 "echo $! >run.pid; wait $!; [ -e watched ] || sleep 3; done; "
                 "wait $watcher; kill -INT $twin; wait $twin");
  }
};

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
  // On a busy core drives may be silent, which is reported.
  if (run.at("bus").at("timeouts") == 0 || run.at("failure") != "not every servo let go") {
    EXPECT_TRUE(run.at("let_go")) << run << outcome.err;
  }
  EXPECT_EQ(run.at("bus").at("overruns"), 0);
}

}  // namespace
}  // namespace verp::tool::test
