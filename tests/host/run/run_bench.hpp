#pragma once
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/control/step.hpp"
#include "common/safety/machine.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/hil/safe_table.hpp"
#include "tests/host/run/process.hpp"
#include "tests/support/delaying_link.hpp"

namespace verp::tool::test {

using Json = nlohmann::json;

/// `verp run` on a serial port, with a cable to disturb. `verp hil` serves the twin in real time.
class RunBench : public Program {
 protected:
  void serve(const std::string& model = "generic21") {
    twin_.reset();
    const std::string twin = "unix-listen:" + (folder_ / "twin").string();
    twin_ = std::make_unique<Process>(
        folder_, "twin",
        with_bus({"hil", model, "--realtime", "--for", "3600", "--json", "--link", twin}));
    ASSERT_TRUE(twin_->says("waits for a controller")) << twin_->said();
  }
  void plug(const verp::test::Latency& latency) {
    cable_.reset();
    cable_ = std::make_unique<verp::test::DelayingLink>(
        "pty:" + port(), "unix:" + (folder_ / "twin").string(), latency);
  }
  std::string port() const { return (folder_ / "tty").string(); }
  std::unique_ptr<Process> run(std::vector<std::string> more) {
    const std::string baud = bus_ == "feetech" ? "1000000" : "2000000";
    std::vector<std::string> words =
        with_bus({"run", "generic21", "--link", "serial:" + port() + "@" + baud, "--json"});
    const bool timed = std::find(more.begin(), more.end(), "--for") != more.end();
    if (!timed && std::find(more.begin(), more.end(), "--action") == more.end()) {
      words.insert(words.end(), {"--for", "3"});
    }
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Process>(folder_, "run", words);
  }
  record::Trace trace() const { return record::read_trace(folder_ / "run.mcap"); }

  std::vector<std::string> with_bus(std::vector<std::string> words) const {
    if (!bus_.empty()) words.insert(words.end(), {"--bus", bus_});
    return words;
  }

  std::string bus_;  ///< empty: the robot's first
  std::unique_ptr<Process> twin_;
  std::unique_ptr<verp::test::DelayingLink> cable_;
};

inline void expect_same_account(const Json& result, const record::Trace& trace) {
  std::uint64_t overruns = 0, skipped = 0;
  for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
    overruns += (trace.ticks[i].inputs.flags & kOverrun) != 0 ? 1 : 0;
    if (i > 0) skipped += trace.ticks[i].inputs.tick - trace.ticks[i - 1].inputs.tick - 1;
  }
  EXPECT_EQ(result.at("ticks"), trace.ticks.size());
  EXPECT_EQ(result.at("deadlines").at("missed"), overruns);
  EXPECT_EQ(result.at("deadlines").at("skipped_periods"), skipped);
}

/// A referee compares modes, causes, torque and goals with the written table, in time rather than
/// ticks. Torque is off at the end. `seen` gets bit m for mode m.
inline void expect_table(const record::Trace& trace, std::uint32_t* seen = nullptr) {
  auto state = std::make_unique<State>();
  Outputs outputs;
  verp::test::SafeTable safe(trace.params);
  const action::Library actions = trace.library();
  for (const TickRecord& tick : trace.ticks) {
    step(trace.params, actions, *state, tick.inputs, outputs);
    ASSERT_EQ(state->digest.chain, tick.digest.chain) << "tick " << tick.inputs.tick;
    safe.tick(tick.inputs, outputs);
  }
  EXPECT_EQ(safe.violation(), "");
  EXPECT_EQ(outputs.torque_enable, 0u);
  if (seen != nullptr) *seen = safe.seen();
}

}  // namespace verp::tool::test
