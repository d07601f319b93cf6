#include "host/run/session/remote_controller.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include "host/os/link/link.hpp"
#include "tests/host/session/plans.hpp"
#include "tests/host/tool/link_controller.hpp"

namespace verp::session::test {
namespace {

namespace fs = std::filesystem;

TEST(RemoteController, WalksBesideARobotOfThisProcessAndBothHaveTheBitsTheyHaveAlone) {
  const WalkPlan here = plan_of("can", -1), there = plan_of("dxl", 1, 2);
  const fs::path folder = fs::temp_directory_path() / ("served" + std::to_string(::getpid()));
  fs::create_directory(folder);
  const std::string bus = (folder / "bus").string(), orders = (folder / "orders").string();
  std::string told;
  const ServeOptions options{.link = "unix-listen:" + bus,
                             .operator_link = "unix-listen:" + orders,
                             .pace = Pace::kLockstep,
                             .told = [&](const std::string& line) { told += line + "\n"; }};
  Chain chain_here, chain_there;
  verp::test::LinkController controller(there.params, "unix:" + bus, "unix:" + orders);
  Session session;
  session.add(here, keep(chain_here));
  RemoteController* served = nullptr;
  session.add(there, keep(chain_there), [&](Robot& robot) {
    auto made = make_served(robot, options);
    served = made.get();
    return made;
  });
  while (session.tick() != nullptr) {
  }
  controller.join();
  EXPECT_EQ(session.result(0).failure, "");
  EXPECT_EQ(session.result(1).failure, "") << told;
  EXPECT_EQ(served->result().compared, chain_there.size());
  EXPECT_NE(told.find("a controller has come, in lockstep"), std::string::npos) << told;
  EXPECT_TRUE(chain_here == alone(here));
  EXPECT_TRUE(chain_there == alone(there));
  fs::remove_all(folder);
}

// A board's operator does not see the plan's notes.
TEST(RemoteController, SaysWhenTheLegsCannotDoWhatIsAsked) {
  WalkPlan plan = plan_of("dxl");
  plan.velocity.vx_tenth_mm_s = 5000;  // steps of 11 cm in 450 ms; the legs allow 8
  const fs::path folder = fs::temp_directory_path() / ("notes" + std::to_string(::getpid()));
  fs::create_directory(folder);
  const std::string bus = (folder / "bus").string(), orders = (folder / "orders").string();
  std::string told;
  verp::test::LinkController controller(plan.params, "unix:" + bus, "unix:" + orders);
  Session session;
  session.add(plan, {}, [&](Robot& robot) {
    return make_served(robot, {.link = "unix-listen:" + bus,
                               .operator_link = "unix-listen:" + orders,
                               .pace = Pace::kLockstep,
                               .told = [&](const std::string& line) { told += line + "\n"; }});
  });
  while (session.tick() != nullptr) {
  }
  controller.join();
  EXPECT_EQ(session.result(0).failure, "");
  EXPECT_NE(told.find("the legs cannot do what is asked: "), std::string::npos) << told;
  fs::remove_all(folder);
}

// Only requests to the clock are a sign of life.
TEST(RemoteController, WhoGreetsAndThenSendsRubbishLosesItsRobot) {
  const fs::path place = fs::temp_directory_path() / ("rubbish" + std::to_string(::getpid()));
  const WalkPlan plan = plan_of("dxl");
  std::string told;
  Session session;
  session.add(plan, {}, [&](Robot& robot) {
    return make_served(robot, {.link = "unix-listen:" + place.string(),
                               .pace = Pace::kLockstep,
                               .patience_s = 0.3,
                               .told = [&](const std::string& line) { told += line + "\n"; }});
  });
  std::atomic<bool> over = false;
  std::thread client([&] {
    link::Link link(link::parse_endpoint("unix:" + place.string()));
    std::uint8_t packet[lockstep::kMaxClockPacket];
    const lockstep::Hello hello;
    std::uint8_t hello_bytes[sizeof hello];
    std::memcpy(hello_bytes, &hello, sizeof hello);
    const std::size_t size = dxl::encode_write(packet, sizeof packet, lockstep::kClockId,
                                               lockstep::kHelloAddress, hello_bytes, sizeof hello);
    link.write(packet, size, 100'000);
    while (!over) {
      link.write(packet + 5, 7, 10'000);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  while (session.tick() != nullptr) {
  }
  over = true;
  client.join();
  EXPECT_NE(told.find("a controller has come"), std::string::npos) << told;
  EXPECT_NE(session.result(0).failure.find("bytes came, and nothing that asks for the time"),
            std::string::npos)
      << session.result(0).failure;
}

TEST(RemoteController, LetsTheSessionsUserInWhileNobodyComes) {
  const fs::path place = fs::temp_directory_path() / ("nobody" + std::to_string(::getpid()));
  int asked = 0;
  Session session({.interrupted = [&] { return asked > 3; }});
  session.add(plan_of("dxl"), {}, [&](Robot& robot) {
    return make_served(robot, {.link = "unix-listen:" + place.string()});
  });
  while (session.tick() != nullptr) ++asked;
  EXPECT_EQ(asked, 4);
  EXPECT_TRUE(session.result(0).interrupted);
}

}  // namespace
}  // namespace verp::session::test
