#include <fstream>
#include <sstream>

#include "tests/host/run/run_bench.hpp"

// A TimelyRobot needs a period of 20 ms; RealRobot's tests hold on a late machine.
namespace verp::tool::test {
namespace {

using RealRobot = RunBench;
using TimelyRobot = RunBench;

Json result_of(const Outcome& outcome) {
  const Json result = Json::parse(outcome.out, nullptr, false);
  EXPECT_TRUE(result.is_object()) << outcome.out << outcome.err;
  return result.is_object() ? result : Json::object();
}

TEST_F(RealRobot, RefusesWhatCannotBe) {
  expect_refused("run", "--link");
  expect_refused("run --link nonsense", "nonsense");
  expect_refused("run --link pty: --imu maybe", "--imu");
  expect_refused("run --link pty: --period 40", "--period");
  expect_refused("run --link pty: --torque 0", "--torque");
  expect_refused("run --link pty: --set gait.lift=1", "verp run: --set");
  expect_refused("run nobody --link pty:", "nobody");
  expect_refused("run --link pty: --action nonesuch", "nonesuch");
  expect_refused("run --link pty: --action wave --for 5", "--for");
  expect_refused("run --link pty: --gains 5", "--gains");
  const std::string rate = "run --link serial:/dev/null@1000000";
  expect_refused(rate, "the bus of generic21 at 2000000");
  expect_refused(
      "run --bus can --link can:can0 --take-orders --cycle 0.3 --set gait.max_step_m=0.2",
      "gait.max_step_m=0.0");
  const Outcome shortened = verp(
      "run --step 0.15 --cycle 0.34 --set gait.max_step_m=0.3 --link serial:/dev/nothing@2000000");
  EXPECT_NE(shortened.err.find("% of the velocity asked for: its joint"), std::string::npos)
      << shortened.err;
  const Outcome nothing = verp("run --link serial:/dev/nothing@2000000");
  EXPECT_EQ(nothing.status, 3);
  EXPECT_NE(nothing.err.find("no such device"), std::string::npos);
}

TEST_F(RealRobot, NoTorqueBeforeTheChecklistIsConfirmed) {
  serve();
  plug({1000, 1000});
  for (const char* typed : {"", "no\n", "\n"}) {
    auto program = run({"--period", "20"});
    ASSERT_TRUE(program->says("Type yes")) << program->wait().err;
    program->type(typed);
    program->hang_up();
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.status, 2);
    for (const char* point : {"hangs from a strap", "switch cuts", "--torque 30"}) {
      EXPECT_NE(outcome.err.find(point), std::string::npos) << point;
    }
  }
  EXPECT_EQ(cable_->ticks(), 0u);
  auto program = run({"--period", "20"});
  ASSERT_TRUE(program->says("Type yes"));
  program->type("yes\n");
  EXPECT_TRUE(program->says("relaxed to rising"));
}

// A forwarded port may lead to real servos.
TEST_F(RealRobot, TheChecklistIsAskedOnEveryLink) {
  serve();
  const auto refuses = [this](const std::string& link, const std::string& other_end) {
    SCOPED_TRACE(link);
    const std::vector<std::string> words = {"run",      "generic21", "--link", link,
                                            "--period", "20",        "--for",  "3"};
    Process program(folder_, "run", words);
    if (!other_end.empty()) {
      ASSERT_TRUE(program.says("waiting for the robot"));
      cable_ = std::make_unique<verp::test::DelayingLink>(
          other_end, "unix:" + (folder_ / "twin").string(), verp::test::Latency{});
    }
    EXPECT_TRUE(program.says("Type yes")) << program.wait().err;
    program.hang_up();
    EXPECT_EQ(program.wait().status, 2);
    cable_.reset();
  };
  refuses("unix:" + (folder_ / "twin").string(), "");
  refuses("pty:" + port(), "serial:" + port() + "@2000000");
  refuses("unix-listen:" + port(), "unix:" + port());
}

// In the table's order, also at a closing terminal or shutdown.
TEST_F(TimelyRobot, AnInterruptSitsTheRobotDown) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    serve();  // the released robot lies on the floor
    plug({1000, 1000});
    auto program = run({"--yes", "--period", "20", "--for", "60", "--record", "run.mcap"});
    ASSERT_TRUE(program->says("relaxed to rising"));
    program->signal(signal);
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.status, 128 + signal);
    EXPECT_NE(outcome.err.find("sits down"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("to sitting"), std::string::npos) << outcome.err;
    const Json result = result_of(outcome);
    EXPECT_EQ(result.value("interrupted", false), true);
    EXPECT_EQ(result.value("let_go", false), true) << outcome.err;
    expect_table(trace());
    fs::remove(folder_ / "run.mcap");
  }
}

TEST_F(TimelyRobot, PlaysAnActionThenLiesDownAndLetsGo) {
  serve();
  plug({1000, 1000});
  auto program =
      run({"--yes", "--period", "20", "--action", "wave", "--gains", "80", "--record", "run.mcap"});
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("standing to acting"), std::string::npos) << outcome.err;
  const Json result = result_of(outcome);
  EXPECT_GT(result.value("action_s", 0.0), 1.0);
  EXPECT_EQ(result.value("let_go", false), true);
  EXPECT_EQ(result.value("ended", ""), "lies on its front");
  EXPECT_EQ(verp("replay run.mcap").status, 0);
}

Json verdict_of(Process& twin, int status) {
  twin.signal(SIGINT);
  const Outcome outcome = twin.wait();
  EXPECT_EQ(outcome.status, status) << outcome.err;
  return result_of(outcome);
}

TEST_F(TimelyRobot, LyingDownAfterAGoodWalkIsNoFall) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--for", "60"});
  ASSERT_TRUE(program->says("rising to standing"));
  program->signal(SIGINT);
  EXPECT_EQ(result_of(program->wait()).value("let_go", false), true);
  EXPECT_TRUE(twin_->says("let go and lies down"));
  EXPECT_EQ(verp("bus ping --id 1 --link serial:" + port() + "@2000000").status, 0);
  const Json result = verdict_of(*twin_, 0);
  EXPECT_EQ(result.value("fallen", true), false);
  EXPECT_EQ(result.value("let_go_and_lies", false), true);
}

TEST_F(RealRobot, GoingDownUnderTorqueIsAFall) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--torque", "5", "--for", "60"});
  const Outcome fell = twin_->wait();
  EXPECT_EQ(fell.status, 1) << fell.err;
  EXPECT_EQ(result_of(fell).value("fallen", false), true);
  EXPECT_NE(program->wait().status, 0);
}

TEST_F(RealRobot, ASecondInterruptLetsGoAtOnce) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--for", "60", "--record", "run.mcap"});
  ASSERT_TRUE(program->says("relaxed to rising"));
  program->signal(SIGINT);
  ASSERT_TRUE(program->says("sits down"));
  std::this_thread::sleep_for(std::chrono::milliseconds(400));  // else both count as one press
  program->signal(SIGINT);
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 128 + SIGINT);
  EXPECT_NE(outcome.err.find("to stopped (emergency stop"), std::string::npos) << outcome.err;
  EXPECT_EQ(result_of(outcome).value("let_go", false), true) << outcome.err;
  expect_table(trace());
}

TEST_F(TimelyRobot, ALostCableIsNamedAndEndsByTheTable) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--for", "60", "--record", "run.mcap"});
  ASSERT_TRUE(program->says("rising to standing"));
  cable_.reset();
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 3);
  for (const char* said :
       {"the link is lost", "to holding (", "holding to sitting", "sitting to lying down",
        "lying down to relaxed", "21 servos did not say that they let go"}) {
    EXPECT_NE(outcome.err.find(said), std::string::npos) << said << "\n" << outcome.err;
  }
  const Json result = result_of(outcome);
  EXPECT_EQ(result.value("let_go", true), false);
  EXPECT_NE(result.value("failure", "").find("let go by itself"), std::string::npos);
  EXPECT_EQ(result.at("bus").at("losses"), 1);
  expect_same_account(result, trace());
  expect_table(trace());
}

TEST_F(TimelyRobot, ACableThatComesBackGoesOn) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--for", "60", "--record", "run.mcap"});
  ASSERT_TRUE(program->says("rising to standing"));
  cable_->cut_for(10);
  ASSERT_TRUE(program->says("to holding ("));
  EXPECT_TRUE(program->says("holding to rising"));
  EXPECT_TRUE(program->says("rising to standing"));
  program->signal(SIGINT);
  EXPECT_EQ(program->wait().status, 128 + SIGINT);
  expect_table(trace());
}

TEST_F(TimelyRobot, ACrashLeavesTheTrace) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--for", "60", "--record", "run.mcap"});
  ASSERT_TRUE(program->says("relaxed to rising"));
  while (cable_->ticks() < 300 && !program->over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  program->signal(SIGKILL);
  program->wait();
  std::string part;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("run.mcap")) part = name;
  }
  ASSERT_EQ(verp("trace recover " + part + " -o whole.mcap").status, 0) << part;
  const record::Trace whole = record::read_trace(folder_ / "whole.mcap");
  EXPECT_GE(whole.ticks.size(), 250u);
  EXPECT_EQ(verp("replay whole.mcap").status, 0);
}

/// No IMU answers.
std::string with_its_imu_elsewhere(const fs::path& folder) {
  std::ifstream in(std::string(VERP_SOURCE_DIR) + "/common/robots/generic21/robot.sdf");
  std::stringstream text;
  text << in.rdbuf();
  std::string robot = text.str();
  const std::string own = "id=\"120\"";
  robot.replace(robot.find(own), own.size(), "id=\"121\"");
  const fs::path file = folder / "elsewhere.sdf";
  std::ofstream(file) << robot;
  return file.string();
}

// There is no torque without the model's IMU. With --imu none the robot runs without balance, and
// the trace records that.
TEST_F(TimelyRobot, ASilentImuIsNeverPassedOver) {
  serve(with_its_imu_elsewhere(folder_));
  plug({1000, 1000});
  const Outcome refused = run({"--yes", "--period", "20"})->wait();
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("the IMU (device 120) does not answer"), std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("--imu none"), std::string::npos);
  EXPECT_EQ(cable_->ticks(), 0u);
  auto program = run({"--yes", "--period", "20", "--imu", "none", "--record", "run.mcap"});
  EXPECT_TRUE(program->says("balance is off"));
  EXPECT_TRUE(program->says("rising to standing"));
  program->signal(SIGINT);
  const Json result = result_of(program->wait());
  EXPECT_EQ(result.value("imu", ""), "none");
  const record::Trace taken = trace();
  EXPECT_EQ(taken.params.imu.device_id, 0);
  EXPECT_EQ(taken.params.tuning.balance.feedback_enable, 0);
  EXPECT_EQ(taken.params.tuning.balance.zeros_enable, 0);
  EXPECT_EQ(taken.params.tuning.gait.heading_gain, 0);
  EXPECT_EQ(taken.metadata.at("imu"), "none: assumed upright");
  expect_table(taken);
}

TEST_F(TimelyRobot, TorqueIsLimitedInEveryServo) {
  serve();
  plug({1000, 1000});
  auto program = run({"--yes", "--period", "20", "--torque", "30"});
  ASSERT_TRUE(program->says("rising to standing"));  // before, the twin holds it up
  program->signal(SIGINT);
  EXPECT_EQ(result_of(program->wait()).value("torque_percent", 0), 30);
  for (const char* id : {"1", "14", "21"}) {
    Outcome read;  // retries on a late PC
    for (int i = 0; i < 20 && read.out.find("registers") == std::string::npos; ++i) {
      read = verp("bus read --register goal_pwm --json --id " + std::string(id) +
                  " --link serial:" + port() + "@2000000");
    }
    EXPECT_EQ(Json::parse(read.out).at("registers").at("goal_pwm"), 885 * 30 / 100) << read.err;
  }
}

}  // namespace
}  // namespace verp::tool::test
