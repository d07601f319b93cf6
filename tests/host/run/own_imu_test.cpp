#include "tests/host/run/run_bench.hpp"

// `verp run --imu serial:...,bno055` with the twin's IMU behind a BNO055's UART (`verp hil
// --imu-serial`), and a cable between them to pull.
namespace verp::tool::test {
namespace {

class OwnImuBench : public RunBench {
 protected:
  void serve_with_imu(const std::string& bus) {
    bus_ = bus;
    const std::string twin = "unix-listen:" + (folder_ / "twin").string();
    twin_ = std::make_unique<Process>(
        folder_, "twin",
        with_bus({"hil", "generic21", "--realtime", "--for", "3600", "--json", "--link", twin,
                  "--imu-serial", "unix-listen:" + (folder_ / "chip").string()}));
    ASSERT_TRUE(twin_->says("waits for a controller")) << twin_->said();
    plug({1000, 1000});
    plug_imu();
  }
  void plug_imu() {
    imu_cable_ = std::make_unique<verp::test::DelayingLink>(
        "pty:" + imu(), "unix:" + (folder_ / "chip").string(), verp::test::Latency{});
  }
  std::string imu() const { return (folder_ / "imu").string(); }
  std::unique_ptr<Process> run_with_imu(std::vector<std::string> more) {
    more.insert(more.end(), {"--yes", "--period", "20", "--imu", "serial:" + imu() + ",bno055",
                             "--record", "run.mcap"});
    return run(std::move(more));
  }
  void expect_walks() {
    const Outcome outcome = run_with_imu({})->wait();
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const Json result = Json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(result.is_object()) << outcome.out;
    EXPECT_GT(result.value("walked_s", 0.0), 2.5);
    EXPECT_EQ(result.value("imu", ""), "bno055 on " + imu());
    EXPECT_EQ(result.value("ended", ""), "lies on its front");
    const record::Trace taken = trace();
    EXPECT_EQ(taken.params.imu.device_id, 0);
    EXPECT_NE(taken.params.tuning.balance.feedback_enable, 0);
    EXPECT_EQ(taken.metadata.at("imu"), "bno055 on " + imu());
    const std::size_t half = taken.ticks.size() / 2;  // the end lies on the floor
    std::size_t fresh = 0;
    double up_m_s2 = 0;
    for (const TickRecord& tick : taken.ticks) {
      fresh += (tick.inputs.flags & (kImuFresh | kImuAssumed)) == kImuFresh ? 1u : 0u;
      if (tick.inputs.tick < half) {
        up_m_s2 += static_cast<double>(taken.params.imu.accel_m_s2_per_count) *
                   tick.inputs.accel_count[2] / static_cast<double>(half);
      }
    }
    EXPECT_GT(fresh, 9 * taken.ticks.size() / 10) << "of " << taken.ticks.size();
    EXPECT_NEAR(up_m_s2, 9.8, 0.5);
    expect_table(taken);
    twin_->signal(SIGINT);
    EXPECT_EQ(Json::parse(twin_->wait().out).value("fallen", true), false);
  }

  std::unique_ptr<verp::test::DelayingLink> imu_cable_;
};
using TimelyImu = OwnImuBench;
using RealImu = OwnImuBench;

TEST_F(TimelyImu, WalksByABno055BesideDynamixelServos) {
  serve_with_imu("");
  expect_walks();
}

TEST_F(TimelyImu, WalksByABno055BesideFeetechServos) {
  serve_with_imu("feetech");
  expect_walks();
}

TEST_F(TimelyImu, ItsOwnImuUnpluggedIsNamedAndFoundAgainOrEndsByTheTable) {
  serve_with_imu("");
  auto program = run_with_imu({"--for", "60"});
  ASSERT_TRUE(program->says("standing to walking")) << program->said();
  imu_cable_.reset();
  ASSERT_TRUE(program->says("to holding (")) << program->said();
  plug_imu();
  EXPECT_TRUE(program->says("the IMU is back")) << program->said();
  EXPECT_TRUE(program->says("standing to walking")) << program->said();
  imu_cable_.reset();
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 3);
  for (const char* said : {": the IMU is silent", "to holding (", "holding to sitting",
                           "is silent: check its cable"}) {
    EXPECT_NE(outcome.err.find(said), std::string::npos) << said << "\n" << outcome.err;
  }
  EXPECT_NE(outcome.err.find("bno055 on " + imu()), std::string::npos) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out).value("let_go", false), true);
  expect_table(trace());
}

TEST_F(RealImu, ShowsWhatItFeels) {
  serve_with_imu("");
  const Outcome felt = verp("bus imu --for 0.3 --json --imu serial:" + imu() + ",bno055");
  ASSERT_EQ(felt.status, 0) << felt.err;
  const Json accel = Json::parse(felt.out).at("accel_m_s2");
  EXPECT_NEAR(accel.at(2).get<double>(), 9.8, 0.5);
  EXPECT_NEAR(accel.at(0).get<double>(), 0, 1.5);
}

TEST_F(RealImu, AnOwnImuThatCannotBeIsRefusedBeforeTorque) {
  const std::string run = "run --link pty: --imu ";
  expect_refused(run + "i2c:/dev/i2c-1,bno056", "bno055");
  expect_refused(run + "i2c:/dev/i2c-1,bno055,address=0x30", "0x28 or 0x29");
  expect_refused(run + "serial:/dev/ttyUSB0,bno055,mount=x:x:z", "mount=-y:x:z");
  expect_refused(run + "serial:/dev/ttyUSB0,bno055,mount=y:x:z", "left hand");
  expect_refused(run + "serial:/dev/ttyUSB0,bno055 --lockstep", "--lockstep");
  const Outcome absent = verp(run + "i2c:/dev/i2c-99,bno055 --yes");
  EXPECT_EQ(absent.status, 3);
  EXPECT_NE(absent.err.find("/dev/i2c-99: no such device"), std::string::npos) << absent.err;
  link::Link nobody(link::parse_endpoint("pty:" + imu()));
  const Outcome silent = verp(run + "serial:" + imu() + ",bno055 --yes");
  EXPECT_EQ(silent.status, 3);
  EXPECT_NE(silent.err.find("no such chip answers at 115200 baud"), std::string::npos)
      << silent.err;
}

}  // namespace
}  // namespace verp::tool::test
