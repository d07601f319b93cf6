#include <chrono>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/run/run_bench.hpp"
#include "tests/host/tool/link_controller.hpp"

// Delayed bytes and a PC that stops cost time but no bit.
namespace verp::tool::test {
namespace {

using verp::test::DelayingLink;
using verp::test::LinkController;

class LateLockstep : public Program {
 protected:
  /// PC and cable stop `stalls` times.
  void walk(std::uint64_t latency_us, int stalls) {
    const Outcome here = verp("walk --json --for 3", "walk");
    const std::string bus = (folder_ / "bus").string(), orders = (folder_ / "orders").string();
    Process twin(folder_, "twin",
                 {"hil", "generic21", "--lockstep", "--physics-step", "2", "--for", "3", "--json",
                  "--link", "unix-listen:" + bus, "--operator", "unix-listen:" + orders});
    ASSERT_TRUE(twin.says("waits for a controller"));
    DelayingLink cable("unix-listen:" + bus + "-far", "unix:" + bus, {latency_us, latency_us});
    const Params params = model::make_params(model::load_robot(model::find_model("generic21")));
    LinkController controller(params, "unix:" + bus + "-far", "unix:" + orders);
    ASSERT_TRUE(stalls == 0 || twin.says("has come, in lockstep"));
    for (int i = 0; i < stalls && !twin.over(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(150 + 70 * i));
      i % 2 == 0 ? cable.stall(350'000) : static_cast<void>(twin.stand_still_us(350'000));
    }
    const Outcome outcome = twin.wait();
    controller.join();
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json result = Json::parse(outcome.out), expected = Json::parse(here.out);
    EXPECT_EQ(result.at("digest"), expected.at("digest"));
    EXPECT_EQ(result.at("compared_ticks"), expected.at("ticks"));
    EXPECT_EQ(result.at("fallen"), false);
    // The last read gets the end.
    EXPECT_GE(cable.ticks(), expected.at("ticks")) << "every tick came over the slow cable";
  }
};

TEST_F(LateLockstep, OneMillisecondCostsNoBit) {
  walk(1000, 0);
}

TEST_F(LateLockstep, FourMillisecondsAndStallsOfThePcCostNoBit) {
  walk(4000, 8);
}

TEST_F(LateLockstep, SixteenMillisecondsCostNoBit) {
  walk(16000, 0);
}

}  // namespace
}  // namespace verp::tool::test
