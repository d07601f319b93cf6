#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "firmware/app/can_nodes.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/can/capture.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using verp::test::Capture;
using verp::test::Decoded;
using Frames = std::vector<Decoded>;

constexpr unsigned kJoint = 19;  ///< the head's yaw carries least of the robot

void rest(int time_ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(time_ms));
}

class Twin {
 public:
  explicit Twin(const fs::path& folder)
      : out_(folder / "twin.out"),
        err_(folder / "twin.err"),
        child_({.words = {VERP_PROGRAM, "hil", "generic21", "--bus", "can", "--link", "can:vcan0",
                          "--realtime", "--json", "--for", "60"},
                .input = {},
                .output = {.file = out_},
                .error = process::Stream{.file = err_}}) {
    const auto waits = [this] {
      return errors().find("waits for a controller") != std::string::npos;
    };
    for (int i = 0; i < 1000 && !waits(); ++i) rest(20);
    EXPECT_TRUE(waits()) << errors();
  }
  /// By Ctrl-C; returns the exit status.
  int stop() {
    child_.tell(SIGINT);
    return child_.wait();
  }
  json result() const { return json::parse(slurp(out_)); }
  std::string errors() const { return slurp(err_); }

 private:
  fs::path out_, err_;
  process::Child child_;
};

class ForeignMaster : public Program {
 protected:
  ForeignMaster() {
    for (int slot = 0; slot < app::kCanNodes; ++slot) {
      const std::uint8_t id = app::node_id(params, slot);
      if (id != 0) nodes.push_back(id);
      if (id != 0 && app::is_joint(slot)) drives.push_back(id);
    }
    std::sort(nodes.begin(), nodes.end());
    std::sort(drives.begin(), drives.end());
  }
  void cansend(const std::string& frame) const {
    ASSERT_EQ(shell("cansend vcan0 " + frame, "cansend").status, 0) << frame;
  }
  void ask(const Capture& capture, const std::string& frame, const std::string& answer) const {
    cansend(frame);
    capture.await(answer);
  }
  static Frames of(const Frames& all, const char* words, unsigned node) {
    Frames some;
    for (const Decoded& each : all) {
      if (each.is(words) && each.node == node) some.push_back(each);
    }
    return some;
  }

  const Params params =
      model::make_params(model::load_robot(model::find_model("generic21"), "can"));
  std::vector<unsigned> nodes, drives;
};

TEST_F(ForeignMaster, StartsTheDrivesMovesAJointAndReadsItBack) {
  Capture capture(folder_);
  Twin twin(folder_);
  const Outcome master =
      shell("/usr/bin/python3 " VERP_SOURCE_DIR "/tests/can/foreign_master.py vcan0 " +
            std::to_string(kJoint));
  ASSERT_EQ(master.status, 0) << master.err << twin.errors();
  EXPECT_EQ(twin.stop(), 0) << twin.errors();
  const json told = json::parse(master.out);
  EXPECT_EQ(told.at("nodes").get<std::vector<unsigned>>(), nodes);
  EXPECT_EQ(told.at("drives").get<std::vector<unsigned>>(), drives);
  EXPECT_TRUE(told.at("without_torque").empty()) << told.at("without_torque");
  const int start = told.at("start"), target = told.at("target"), position = told.at("position");
  EXPECT_NEAR(position, target, 40) << "from " << start;
  EXPECT_EQ(told.at("heartbeat"), "7f") << "pre-operational";

  const json& fault = told.at("fault");
  EXPECT_EQ(fault.at("emergency").get<std::string>().substr(0, 6), "118621");
  EXPECT_EQ(fault.at("error_code"), 0x8611);
  EXPECT_EQ(fault.at("statusword").get<unsigned>() & 0x6F, 0x08u) << "fault";
  EXPECT_EQ(fault.at("after_reset").get<unsigned>() & 0x6F, 0x40u) << "switch on disabled";

  const json result = twin.result();
  EXPECT_EQ(result.at("pace"), "real time");
  EXPECT_EQ(result.at("link").at("dropped"), 0);
  EXPECT_EQ(result.at("link").at("overruns"), 0);

  const Frames frames = capture.decode();
  const Frames emergencies = of(frames, "EMCY", kJoint);
  ASSERT_EQ(emergencies.size(), 2u);
  EXPECT_EQ(emergencies[0].error_code, 0x8611u);
  EXPECT_EQ(emergencies[0].error_register, 0x21u) << "generic, of the profile";
  EXPECT_EQ(emergencies[1].error_code, 0u) << "it is over";
  std::vector<int> seen;
  for (const Decoded& each : of(frames, "PDO1 (tx)", kJoint)) {
    if (each.data.size() == 6) seen.push_back(static_cast<int>(each.value(2, 4)));
  }
  EXPECT_EQ(json(seen), told.at("seen"));
  const Frames targets = of(frames, "PDO1 (rx)", kJoint);
  ASSERT_GE(targets.size(), 2u);
  EXPECT_EQ(static_cast<int>(targets[targets.size() - 2].value(0, 4)), target);
  std::vector<unsigned> states;
  for (const Decoded& each : of(frames, "NMT Error Control", kJoint)) {
    if (states.empty() || states.back() != each.state) states.push_back(*each.state);
  }
  // The node boots when time begins, and on command.
  EXPECT_EQ(states, (std::vector<unsigned>{0x00, 0x7F, 0x05}));
}

TEST_F(ForeignMaster, ACia402MasterStartsADriveByWhatItTellsByItself) {
  Twin twin(folder_);
  const Outcome master =
      shell("/usr/bin/python3 " VERP_SOURCE_DIR "/tests/can/cia402_start.py vcan0 " +
            std::to_string(kJoint));
  ASSERT_EQ(master.status, 0) << master.err << twin.errors();
  EXPECT_EQ(twin.stop(), 0) << twin.errors();
  const json told = json::parse(master.out);
  EXPECT_EQ(told.at("first"), 0x00020192) << "the first frame to a twin is answered";
  EXPECT_EQ(told.at("start_up"), json({0x40, 0x21, 0x23, 0x27}));
  EXPECT_EQ(told.at("again"), 0x27) << "from pre-operational, with torque";
  EXPECT_EQ(told.at("modes"), 0xA1) << "1, 6 and 8";
  const json& set_point = told.at("set_point");
  EXPECT_EQ(set_point.at("taken").get<unsigned>() & 0x3000, 0x1000u) << "without following error";
  EXPECT_NEAR(set_point.at("moved").get<int>(), 400, 45) << "the window, and the encoder's noise";
  const json& home = told.at("home");
  EXPECT_EQ(home.at("refused"), true);
  EXPECT_EQ(home.at("before"), 0x0400) << "not started";
  EXPECT_EQ(home.at("after"), 0x1400) << "attained";
  EXPECT_NEAR(home.at("position").get<int>(), 0, 45);
  const json& silent = told.at("silent");
  EXPECT_EQ(silent.at("emergency").get<std::string>().substr(0, 6), "308111");
  EXPECT_EQ(silent.at("state"), "7f") << "pre-operational";
  EXPECT_EQ(silent.at("statusword"), 0x08) << "fault";
  EXPECT_EQ(silent.at("error_register"), 0x11);
  EXPECT_EQ(silent.at("error_code"), 0x8130);
  EXPECT_EQ(told.at("stopped"), 0x40) << "no fault";
  EXPECT_EQ(told.at("stored"), json({1000, 700, 1000}));
  EXPECT_EQ(told.at("increments"), 16384);
  EXPECT_GT(told.at("rated_ma"), 1000);
  EXPECT_GT(told.at("rated_mn_m"), 1000);
}

TEST_F(ForeignMaster, FramesTypedByHandAreAnswered) {
  Twin twin(folder_);
  Capture capture(folder_);
  ask(capture, "000#8113", "713#00");                    // reset node 19
  ask(capture, "613#4000100000000000", "593#43001000");  // read 1000h
  ask(capture, "613#40FF5F0000000000", "593#80");        // a missing object
  ask(capture, "613#2B17100014000000", "593#60");        // set 1017h to 20 ms
  ask(capture, "000#0113", "713#05");                    // NMT: start
  ask(capture, "613#4041600000000000", "593#4B4160");    // SDO: statusword
  EXPECT_EQ(twin.stop(), 0) << twin.errors();
  EXPECT_EQ(twin.result().at("link").at("overruns"), 0);
  const Frames frames = capture.decode();
  const Frames answers = of(frames, "Default-SDO (tx)", kJoint);
  ASSERT_EQ(answers.size(), 4u);
  EXPECT_EQ(answers[0].index, 0x1000u);
  EXPECT_EQ(answers[0].value(0, 4), 0x00020192u) << "a servo drive of CiA 402";
  EXPECT_EQ(answers[1].abort_code, 0x06020000u) << "no such object";
  EXPECT_TRUE(answers[2].is("Default-SDO (tx): Initiate download response"));
  EXPECT_EQ(answers[3].value(0, 2) & 0x6F, 0x40u) << "switch on disabled";
  const Frames signs = of(frames, "NMT Error Control", kJoint);
  ASSERT_GT(signs.size(), 3u);
  EXPECT_EQ(signs.front().state, 0x00u);
  EXPECT_EQ(signs.back().state, 0x05u);
}

TEST_F(ForeignMaster, RandomTrafficEndsNothing) {
  Twin twin(folder_);
  for (const char* kind : {"", "-e", "-R", "-I 000 -L 2", "-I 613 -L 8", "-I 080"}) {
    const Outcome noise = shell(std::string("cangen vcan0 -g 0 -n 300 -p 10 ") + kind, "cangen");
    ASSERT_EQ(noise.status, 0) << noise.err;
  }
  Capture capture(folder_);
  cansend("000#8100");
  for (const unsigned node : nodes) {
    capture.await(fmt::format("7{:02X}#00", node));
    ASSERT_FALSE(HasFailure()) << "the twin's status: " << twin.stop() << '\n' << twin.errors();
  }
  ask(capture, "613#4000100000000000", "593#4300100092010200");
  const int status = twin.stop();
  EXPECT_EQ(status, 0) << status << twin.errors();
  const json link = twin.result().at("link");
  EXPECT_GT(link.at("frames"), 300);
  EXPECT_EQ(link.at("overruns"), 0);
}

}  // namespace
}  // namespace verp::tool::test
