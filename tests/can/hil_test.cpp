#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "common/protocol/canopen/nmt.hpp"
#include "firmware/app/lockstep_can.hpp"
#include "host/os/link/can_port.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/tool/link_controller.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;

struct CanSocket : link::CanPort {
  explicit CanSocket(const std::string& endpoint) : CanPort(link::parse_endpoint(endpoint)) {}
  ~CanSocket() { EXPECT_EQ(errors().overruns, 0u) << "the controller lost frames"; }
};
using CanController = verp::test::ControllerOn<CanSocket, app::LockstepCan>;

class HilOnCan : public Program {
 protected:
  Params params() const {
    return model::make_params(model::load_robot(model::find_model("generic21"), "can"));
  }
  std::string place(const std::string& name) const { return (folder_ / name).string(); }
  Outcome hil(const std::string& arguments) const {
    return verp("hil --bus can --link can:vcan0 --json " + arguments, "hil");
  }
};

// The PC knows a tick's end when the next one begins, so the walk's numbers are nearly the same.
TEST_F(HilOnCan, WalksWithTheBitsOfSoftwareInTheLoop) {
  const Outcome walk = verp("walk --bus can --json --for 3", "walk");
  ASSERT_EQ(walk.status, 0) << walk.err;
  const json expected = json::parse(walk.out);
  CanController controller(params(), "can:vcan0", "unix:" + place("orders"));
  const Outcome outcome = hil("--for 3 --operator unix-listen:" + place("orders"));
  controller.join();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  for (const char* key : {"digest", "ticks", "duration_s"}) {
    EXPECT_EQ(result.at(key), expected.at(key)) << key;
  }
  EXPECT_NEAR(result.at("distance_m").get<double>(), expected.at("distance_m").get<double>(), 1e-3);
  EXPECT_EQ(result.at("compared_ticks"), expected.at("ticks"));
  EXPECT_EQ(result.at("link").at("damaged"), 0);
  EXPECT_EQ(result.at("link").at("overruns"), 0);
  std::printf("%.0f ticks/s\n", result.at("ticks_per_s").get<double>());
}

TEST_F(HilOnCan, RefusesAnotherRobot) {
  Params other = params();
  other.period_us = 8000;
  CanController controller(other, "can:vcan0", "unix:" + place("orders"));
  const Outcome outcome = hil("--for 3 --operator unix-listen:" + place("orders"));
  controller.join();
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("Params are not those of generic21"), std::string::npos)
      << outcome.err;
}

TEST_F(HilOnCan, RefusesNodesThatAreThereAlready) {
  const std::uint8_t id = params().joint[3].servo_id;
  std::atomic<bool> over = false;
  std::thread drive([&] {
    CanSocket port("can:vcan0");
    CanFrame heartbeat = canopen::classic_frame(canopen::heartbeat_id(id), 1);
    heartbeat.data[0] = static_cast<std::uint8_t>(canopen::NmtState::kPreOperational);
    while (!over) {
      port.send(heartbeat);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  const Outcome outcome = hil("--for 3");
  over = true;
  drive.join();
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("node " + std::to_string(id) + " of this robot is on can:vcan0"),
            std::string::npos)
      << outcome.err;
}

TEST_F(HilOnCan, SaysWhichBusFitsALink) {
  const Outcome serial = verp("hil --bus can --link pty:" + place("pty"), "serial");
  EXPECT_EQ(serial.status, 2);
  EXPECT_NE(serial.err.find("is no CAN interface"), std::string::npos) << serial.err;
  const Outcome can = verp("hil --link can:vcan0", "can");
  EXPECT_EQ(can.status, 2);
  EXPECT_NE(can.err.find("choose another of its buses with --bus"), std::string::npos) << can.err;
  EXPECT_EQ(hil("--realtime --operator unix-listen:" + place("orders")).status, 2);
  const Outcome away = verp("hil --bus can --link can:vcan9 --realtime", "away");
  EXPECT_EQ(away.status, 3);
  EXPECT_EQ(std::count(away.err.begin(), away.err.end(), '\n'), 1) << away.err;
  EXPECT_NE(away.err.find("vcan9"), std::string::npos) << away.err;
}

}  // namespace
}  // namespace verp::tool::test
