#include "tests/host/run/run_bench.hpp"

// Feetech servos at the other end of a pseudo-terminal: `verp hil generic21 --bus feetech`.
namespace verp::tool::test {
namespace {

class FeetechBench : public RunBench {
 protected:
  FeetechBench() { bus_ = "feetech"; }
  void serve_port(std::vector<std::string> more = {}) {
    std::vector<std::string> words =
        with_bus({"hil", "generic21", "--for", "3600", "--json", "--link", "pty:" + port()});
    words.insert(words.end(), more.begin(), more.end());
    twin_ = std::make_unique<Process>(folder_, "twin", words);
    ASSERT_TRUE(twin_->says("waits for a controller")) << twin_->said();
  }
  Outcome bus(const std::string& word, const std::string& more = "") {
    return verp("bus " + word + " --protocol feetech --link serial:" + port() + "@1000000 " + more);
  }
};

/// tests/feetech/foreign_client.py.
class FeetechClient : public FeetechBench {
 protected:
  void plays(const std::string& scene) const {
    const Outcome outcome =
        shell("timeout 100 python3 " VERP_FEETECH_CLIENT " " VERP_PROGRAM " " + scene);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(FeetechClient, IsAnsweredAsTheManualsExamplesAre) {
  plays("manual_examples");
}
TEST_F(FeetechClient, FindsTheMakersMemoryTable) {
  plays("memory_table");
}
TEST_F(FeetechClient, MovesAServoAndLetsItGo) {
  plays("goal_and_back");
}
TEST_F(FeetechClient, KeepsAWriteUntilActionAndHearsNoAnswerToAll) {
  plays("kept_writes");
}
TEST_F(FeetechClient, SetsIdOffsetAndRate) {
  plays("id_and_rate");
}
TEST_F(FeetechClient, LosesNoOtherRequestToGarbage) {
  plays("garbage");
}

TEST_F(FeetechClient, BusWordsFindReadAndWriteServos) {
  serve_port();
  const Outcome found = bus("scan", "--json --timeout 20");
  ASSERT_EQ(found.status, 0) << found.err;
  const Json devices = Json::parse(found.out).at("devices");
  EXPECT_EQ(devices.size(), 24u);
  EXPECT_EQ(devices.at(0).at("name"), "STS3215");
  EXPECT_EQ(bus("write", "--id 19 --register offset -- -300").status, 0);
  EXPECT_EQ(
      Json::parse(bus("read", "--id 19 --register offset --json").out).at("registers").at("offset"),
      -300);
  EXPECT_EQ(bus("write", "--id 19 --register offset -- 3000").status, 2);
  EXPECT_EQ(bus("write", "--id 19 --register present_load 1").status, 2);
  const Outcome unknown = bus("read", "--id 19 --register hardware_error_status");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("STS3215 has no register"), std::string::npos) << unknown.err;
  EXPECT_EQ(bus("ping", "--id 50 --timeout 20").status, 3);
  EXPECT_NE(bus("read").err.find("Give --id"), std::string::npos);
}

TEST_F(FeetechClient, DoctorNamesWhoIsSilentAndWhatIsSetWrong) {
  serve_port();
  const std::string line = "--link serial:" + port() + "@1000000 --timeout 20";
  const Outcome sound = verp("bus doctor generic21 --bus feetech " + line);
  EXPECT_EQ(sound.status, 0) << sound.out << sound.err;
  EXPECT_NE(sound.out.find("24 answer"), std::string::npos) << sound.out;
  EXPECT_EQ(bus("write", "--id 8 --register return_delay 100").status, 0);
  EXPECT_EQ(bus("write", "--id 7 --register lock 0").status, 0);
  bus("write", "--id 7 --register id 57 --timeout 20");
  const Outcome ill = verp("bus doctor generic21 --bus feetech " + line);
  EXPECT_EQ(ill.status, 3) << ill.out << ill.err;
  for (const char* words : {"(id 7)", "does not answer", "which wastes time of each tick: 8",
                            "verp bus setup generic21 --link", "--bus feetech --joint"}) {
    EXPECT_NE(ill.out.find(words), std::string::npos) << words << "\n" << ill.out;
  }
}

TEST_F(FeetechClient, SetupMakesTheMiddleTheModelsZero) {
  serve_port();
  Process setup(folder_, "setup",
                with_bus({"bus", "setup", "generic21", "--wired", "--joint", "head_yaw", "--link",
                          "serial:" + port() + "@1000000", "--json"}));
  ASSERT_TRUE(setup.says("Press Enter to begin"));
  setup.type("\n");
  ASSERT_TRUE(setup.says("Zero: torque is off"));
  setup.type("\n");
  ASSERT_TRUE(setup.says("Direction"));
  setup.type("s\n");
  const Outcome outcome = setup.wait();
  EXPECT_EQ(outcome.status, 1) << "the direction is left to do";
  const Json zero = Json::parse(outcome.out).at("joints").at("head_yaw").at("zero");
  EXPECT_EQ(zero.at("model_offset"), 2048);
  EXPECT_EQ(zero.at("homing_after").get<int>(), zero.at("count").get<int>() - 2048)
      << "a Feetech offset is taken off";
  EXPECT_EQ(
      Json::parse(bus("read", "--id 19 --register lock --json").out).at("registers").at("lock"), 1);
}

using RealFeetechRobot = FeetechBench;

TEST_F(RealFeetechRobot, WalksOnAPtyOfFeetechServos) {
  serve_port();
  auto program = run({"--yes", "--period", "20", "--record", "run.mcap"});
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("NO bus watchdog"), std::string::npos) << "of the checklist";
  const Json result = Json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(result.is_object()) << outcome.out;
  EXPECT_GT(result.value("walked_s", 0.0), 2.5);
  EXPECT_EQ(result.value("let_go", false), true);
  EXPECT_EQ(result.value("ended", ""), "lies on its front");
  expect_table(trace());
  twin_->signal(SIGINT);
  EXPECT_EQ(Json::parse(twin_->wait().out).value("fallen", true), false);
}

TEST_F(RealFeetechRobot, AWrongIdAndAnAbsentServoAreNamedBeforeTorque) {
  serve_port();
  EXPECT_EQ(bus("write", "--id 7 --register lock 0").status, 0);
  bus("write", "--id 7 --register id 57 --timeout 20");
  auto program = run({"--yes", "--period", "20"});
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("device 7 does not answer"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("to rising"), std::string::npos);
}

}  // namespace
}  // namespace verp::tool::test
