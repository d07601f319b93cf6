#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "host/apps/libverp/verp.hpp"
#include "tests/host/libverp/expect_error.hpp"
#include "tests/host/libverp/opened.hpp"

namespace verp::abi::test {
namespace {

TEST(LibverpMisuse, NullsAndSizes) {
  Opened opened;
  opened.add();
  expect_error(verp_session_open(nullptr, nullptr), VERP_BAD_ARGUMENT, "verp_session_open", "null");
  expect_error(verp_session_add(opened.session, nullptr, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_add", "null");
  expect_error(verp_session_tick(nullptr, 1, nullptr, nullptr), VERP_BAD_HANDLE,
               "verp_session_tick", "null");
  expect_error(verp_session_read(opened.session, nullptr, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_read", "null");
  verp_tick tick = {};
  expect_error(verp_session_view(opened.session, 0, &tick), VERP_BAD_ARGUMENT, "verp_session_view",
               "size");
  char small[10];
  expect_error(verp_session_state(opened.session, 0, small, sizeof small), VERP_BAD_ARGUMENT,
               "verp_session_state", "10 bytes");
  verp_world world = {};
  verp_session other = nullptr;
  expect_error(verp_session_open(&world, &other), VERP_BAD_ARGUMENT, "verp_session_open", "size");
  EXPECT_EQ(other, nullptr);
  EXPECT_EQ(verp_layout("nothing"), nullptr);
  EXPECT_EQ(verp_layout(nullptr), nullptr);
  expect_error(verp_replay(nullptr, nullptr, nullptr), VERP_BAD_ARGUMENT, "verp_replay", "null");
}

TEST(LibverpMisuse, NamesAndRanges) {
  Opened opened;
  opened.add();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto session = opened.session;
  expect_error(verp_session_digest(session, 7, nullptr), VERP_BAD_ARGUMENT, "verp_session_digest",
               "null");
  std::uint64_t digest = 0;
  expect_error(verp_session_digest(session, 7, &digest), VERP_BAD_ARGUMENT, "verp_session_digest",
               "no robot 7");
  expect_error(verp_session_read(session, "trunk.colour", &value), VERP_BAD_ARGUMENT,
               "verp_session_read", "trunk.colour");
  expect_error(verp_session_set(session, "trunk.mass_kg", -1), VERP_BAD_ARGUMENT,
               "verp_session_set", "trunk.mass_kg");
  expect_error(verp_session_set(session, "trunk.mass_kg", nan), VERP_BAD_ARGUMENT,
               "verp_session_set", "finite");
  expect_error(verp_session_push(session, "moon", 1, 0, 0, 1), VERP_BAD_ARGUMENT,
               "verp_session_push", "moon");
  expect_error(verp_session_push(session, "trunk", 1, 0, 0, nan), VERP_BAD_ARGUMENT,
               "verp_session_push", "for_s");
  expect_error(verp_session_tune(session, 0, "gait.lift", 0.01), VERP_BAD_ARGUMENT,
               "verp_session_tune", "gait.lift");
  expect_error(verp_session_tune(session, 0, "gait.lift_m", 5), VERP_BAD_ARGUMENT,
               "verp_session_tune", "may be");
  expect_error(verp_session_command(session, 0, 9, 0, 0, 0, 0, 0), VERP_BAD_ARGUMENT,
               "verp_session_command", "request");
  expect_error(verp_session_command(session, 0, 2, 1e9, 0, 0, 0, 0), VERP_BAD_ARGUMENT,
               "verp_session_command", "vx_m_s");
  verp_core core = nullptr;
  expect_error(verp_core_open("no_such_robot", nullptr, nullptr, &core), VERP_BAD_FILE,
               "verp_core_open", "generic21");
  expect_error(verp_core_open("generic21", nullptr, "gait.lift_m", &core), VERP_BAD_ARGUMENT,
               "verp_core_open", "NAME=VALUE");
  expect_error(verp_replay("/no/such.mcap", nullptr, nullptr), VERP_BAD_FILE, "verp_replay",
               "/no/such.mcap");
  EXPECT_EQ(verp_session_tick(session, 1, nullptr, nullptr), VERP_OK) << "and it still runs";
}

/// Found without the drawing program.
TEST(LibverpMisuse, PicturesThatAreNone) {
  Opened opened;
  opened.add();
  const auto session = opened.session;
  std::uint32_t count = 0;
  ASSERT_EQ(verp_session_cameras(session, 0, &count), VERP_OK);
  ASSERT_EQ(count, 1U);
  expect_error(verp_session_cameras(session, 0, nullptr), VERP_BAD_ARGUMENT, "verp_session_cameras",
               "null");
  expect_error(verp_session_cameras(session, 5, &count), VERP_BAD_ARGUMENT, "verp_session_cameras",
               "no robot 5");
  verp_camera camera = {};
  expect_error(verp_session_camera(session, 0, 0, &camera), VERP_BAD_ARGUMENT,
               "verp_session_camera", "size");
  camera.size = sizeof camera;
  expect_error(verp_session_camera(session, 0, 1, &camera), VERP_BAD_ARGUMENT,
               "verp_session_camera", "no camera 1");
  ASSERT_EQ(verp_session_camera(session, 0, 0, &camera), VERP_OK);
  std::vector<std::uint8_t> pixels(std::size_t{3} * camera.width * camera.height);
  const auto read = [&](std::uint32_t index, std::uint32_t what, void* to, std::uint64_t size) {
    return verp_session_picture(session, 0, index, what, to, size, nullptr);
  };
  const std::string name = "verp_session_picture";
  EXPECT_EQ(read(0, VERP_COLOUR, pixels.data(), pixels.size()), VERP_NO_PICTURE);
  expect_error(read(0, VERP_COLOUR, nullptr, 0), VERP_BAD_ARGUMENT, name, "picture is null");
  expect_error(read(0, VERP_COLOUR, pixels.data(), 10), VERP_BAD_ARGUMENT, name, "230400");
  expect_error(read(3, VERP_COLOUR, pixels.data(), 10), VERP_BAD_ARGUMENT, name, "no camera 3");
  for (const std::uint32_t what : {2U, 4U, 1U | 2U, 8U})
    expect_error(read(0, what, pixels.data(), 10), VERP_BAD_ARGUMENT, name, "gives colour");
  expect_error(verp_session_picture(nullptr, 0, 0, VERP_COLOUR, pixels.data(), 10, nullptr),
               VERP_BAD_HANDLE, name, "null");
}

TEST(LibverpMisuse, ViewsThatAreNone) {
  Opened opened;
  opened.add();
  verp_view view = {};
  std::vector<std::uint8_t> pixels(std::size_t{3} * 64 * 48);
  const auto refused = [&](const std::string& why) {
    expect_error(verp_session_render(opened.session, &view, pixels.data(), pixels.size()),
                 VERP_BAD_ARGUMENT, "verp_session_render", why);
  };
  refused("size");
  view.size = sizeof view;
  view.width = 64;
  refused("height may be 16 to 8192");
  view.height = 9000;
  refused("height may be 16 to 8192");
  view.height = 48;
  refused("view->eye_m is where view->target_m is");
  view.fov_rad = 4;
  refused("fov_rad");
  view.fov_rad = 0;
  view.eye_m[1] = std::numeric_limits<double>::infinity();
  refused("eye_m is not a finite number");
  view.name = "";
  refused("name is empty");
  view.name = "front";
  view.robot = 2;
  refused("no robot 2");
  view.robot = 0;
  view.flags = 2;
  refused("flags");
  view.flags = 0;
  pixels.pop_back();
  refused("9215 bytes, not 9216");
  expect_error(verp_session_render(opened.session, &view, nullptr, 0), VERP_BAD_ARGUMENT,
               "verp_session_render", "picture is null");
  expect_error(verp_session_render(opened.session, nullptr, pixels.data(), 1), VERP_BAD_ARGUMENT,
               "verp_session_render", "view is null");
}

TEST(LibverpMisuse, ProgramThatDrawsIsMissing) {
  Opened opened;
  opened.add();
  verp_view view = {};
  view.size = sizeof view;
  view.width = 64;
  view.height = 48;
  view.name = "front";
  std::vector<std::uint8_t> pixels(std::size_t{3} * 64 * 48);
  const auto failed = [&](const char* program, const std::string& why) {
    ASSERT_EQ(::setenv("VERP_CAMERA_PROGRAM", program, 1), 0);
    expect_error(verp_session_render(opened.session, &view, pixels.data(), pixels.size()),
                 VERP_FAILED, "verp_session_render", why);
    ::unsetenv("VERP_CAMERA_PROGRAM");
  };
  failed("/nowhere/verp_camera", "/nowhere/verp_camera, cannot be started (No such file");
  failed("/nowhere/verp_camera", "ninja -C build/host-release verp_camera");
  failed("/bin/false", "has ended, with status 1");
  EXPECT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK) << "and it still runs";
}

TEST(LibverpMisuse, CallsTooEarlyAndTooLate) {
  Opened opened;
  expect_error(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_tick", "verp_session_add");
  opened.add();
  ASSERT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK);
  verp_robot robot;
  ASSERT_EQ(verp_robot_defaults(&robot), VERP_OK);
  expect_error(verp_session_add(opened.session, &robot, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_add", "before the first tick");
  opened.result();
  EXPECT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OVER);
  const verp_session closed = opened.session;
  ASSERT_EQ(verp_session_close(closed), VERP_OK);
  expect_error(verp_session_tick(closed, 1, nullptr, nullptr), VERP_BAD_HANDLE, "verp_session_tick",
               "closed");
  expect_error(verp_session_close(closed), VERP_BAD_HANDLE, "verp_session_close", "closed");
  const verp_lib::Core core;
  expect_error(
      verp_session_tick(reinterpret_cast<verp_session>(core.handle()), 1, nullptr, nullptr),
      VERP_BAD_HANDLE, "verp_session_tick", "never was one");
}

TEST(LibverpMisuse, ControllersThatFail) {
  const auto tick_with = [](verp_controller controller, void* user) {
    Opened opened;
    opened.add();
    EXPECT_EQ(verp_session_control(opened.session, 0, controller, user), VERP_OK);
    const int status = verp_session_tick(opened.session, 1, nullptr, nullptr);
    EXPECT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OVER);
    verp_result result = {};
    result.size = sizeof result;
    EXPECT_EQ(verp_session_result(opened.session, 0, &result), VERP_OK);
    EXPECT_NE(std::string(result.failure).find("controller of robot 0 failed at tick"),
              std::string::npos)
        << "who did not look at the tick's error";
    return status;
  };
  expect_error(tick_with([](const verp_moment*, void*) { return 3; }, nullptr),
               VERP_CALLBACK_FAILED, "verp_session_tick", "gave 3");
  expect_error(tick_with([](const verp_moment*, void*) -> int { throw std::runtime_error("ouch"); },
                         nullptr),
               VERP_CALLBACK_FAILED, "verp_session_tick", "ouch");
  expect_error(verp_decide(12345), VERP_BAD_ARGUMENT, "verp_decide", "from inside one");
  verp_lib::Session session;
  session.add(verp_lib::Session::defaults());
  session.control([](const verp_lib::Moment&) { throw std::out_of_range("mine"); });
  EXPECT_THROW(session.tick(), std::out_of_range) << "C++ gets its own exception back";
}

/// Missing feet, unknown phases and modes, any goals are sent as they are.
TEST(LibverpMisuse, ControllersThatPutOutAnything) {
  for (const int byte : {0x00, 0x03, 0x7f, 0x80, 0xff}) {
    Opened opened;
    opened.add([](verp_robot& robot) { robot.flags = VERP_OPEN_END; });
    int user = byte;
    const auto fill = [](const verp_moment* moment, void* given) {
      std::memset(moment->outputs, *static_cast<int*>(given), sizeof *moment->outputs);
      return 0;
    };
    ASSERT_EQ(verp_session_control(opened.session, 0, fill, &user), VERP_OK);
    const int status = verp_session_tick(opened.session, 150, nullptr, nullptr);
    EXPECT_TRUE(status == VERP_OK || status == VERP_OVER) << byte << ": " << verp_last_error();
    EXPECT_GT(opened.result().ticks, 0U) << byte;
  }
}

TEST(LibverpMisuse, RobotsInEachOther) {
  Opened opened;
  opened.add([](verp_robot& robot) { robot.x_m = 1; });
  verp_robot robot;
  ASSERT_EQ(verp_robot_defaults(&robot), VERP_OK);
  robot.x_m = 1.05;
  expect_error(verp_session_add(opened.session, &robot, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_add", "robot 0 stands there already");
  robot.y_m = 0.5;
  EXPECT_EQ(verp_session_add(opened.session, &robot, nullptr), VERP_OK) << verp_last_error();
}

TEST(LibverpMisuse, TwoThreadsAndACallback) {
  Opened opened;
  opened.add();
  struct Seen {
    verp_session session;
    int own = VERP_OK, other = VERP_OK;
  } seen{opened.session};
  const auto controller = [](const verp_moment* moment, void* user) {
    auto* const told = static_cast<Seen*>(user);
    double value = 0;
    told->own = verp_session_read(told->session, "trunk.mass_kg", &value);
    std::thread([told] {
      told->other = verp_session_tick(told->session, 1, nullptr, nullptr);
    }).join();
    return verp_decide(moment->token);
  };
  ASSERT_EQ(verp_session_control(opened.session, 0, controller, &seen), VERP_OK);
  ASSERT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK);
  EXPECT_EQ(seen.own, VERP_BUSY);
  EXPECT_EQ(seen.other, VERP_BUSY);
  ASSERT_EQ(verp_session_control(opened.session, 0, nullptr, nullptr), VERP_OK);
  EXPECT_EQ(verp_session_tick(opened.session, 1, nullptr, nullptr), VERP_OK);
}

TEST(LibverpMisuse, NumbersThatAreNoneAreNamed) {
  verp_core core = nullptr;
  ASSERT_EQ(verp_core_open("generic21", nullptr, nullptr, &core), VERP_OK);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  float angle_rad[21] = {}, poses[22 * VERP_POSE], com_m[3];
  angle_rad[7] = nan;
  expect_error(verp_core_forward(core, angle_rad, 21, poses), VERP_BAD_ARGUMENT,
               "verp_core_forward", "angle_rad[7] is not a finite number");
  angle_rad[7] = infinite;
  expect_error(verp_core_com(core, angle_rad, 21, com_m), VERP_BAD_ARGUMENT, "verp_core_com",
               "angle_rad[7]");
  float sole[VERP_POSE] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.04F, -infinite};
  float found[VERP_LEG_JOINTS], before[VERP_LEG_JOINTS] = {0, 0, 0, nan, 0, 0};
  std::uint32_t flags = 0;
  expect_error(verp_core_leg_ik(core, 0, sole, nullptr, found, &flags), VERP_BAD_ARGUMENT,
               "verp_core_leg_ik", "sole[11]");
  sole[11] = -0.3F;
  expect_error(verp_core_leg_ik(core, 0, sole, before, found, &flags), VERP_BAD_ARGUMENT,
               "verp_core_leg_ik", "before_rad[3]");
  EXPECT_EQ(verp_core_leg_ik(core, 0, sole, nullptr, found, &flags), VERP_OK);
  std::int32_t count = 0;
  expect_error(verp_core_count(core, 0, nan, &count), VERP_BAD_ARGUMENT, "verp_core_count",
               "angle_rad");
  EXPECT_EQ(verp_core_close(core), VERP_OK);
}

// The child exits with all destructors, in mid-walk.
TEST(LibverpMisuse, ForkedProcessHarmsNoTraceOfItsParent) {
  const std::string trace = testing::TempDir() + "forked-" + std::to_string(getpid()) + ".mcap";
  std::uint64_t digest = 0;
  {
    Opened opened;
    opened.add([&](verp_robot& robot) { robot.record = trace.c_str(); });
    for (int round = 0; round < 3; ++round) {
      ASSERT_EQ(verp_session_tick(opened.session, 50, nullptr, nullptr), VERP_OK);
      const pid_t child = fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        const bool refused =
            verp_session_tick(opened.session, 50, nullptr, nullptr) == VERP_BAD_HANDLE &&
            std::string(verp_last_error()).find("forked") != std::string::npos &&
            verp_session_close(opened.session) == VERP_BAD_HANDLE;
        std::uint64_t ticks = 0;  // handles of its own
        verp_core own = nullptr;
        const bool works = verp_core_open("generic21", nullptr, nullptr, &own) == VERP_OK &&
                           verp_core_digest(own, &ticks) == VERP_OK;
        std::exit(refused && works ? 0 : 1);
      }
      int status = -1;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      EXPECT_EQ(status, 0);
    }
    opened.run();
    ASSERT_EQ(verp_session_digest(opened.session, 0, &digest), VERP_OK);
  }
  std::uint64_t replayed = 0;
  EXPECT_EQ(verp_replay(trace.c_str(), nullptr, &replayed), VERP_OK) << verp_last_error();
  EXPECT_EQ(replayed, digest);
  std::remove(trace.c_str());
}

}  // namespace
}  // namespace verp::abi::test
