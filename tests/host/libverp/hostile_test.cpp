#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "host/apps/libverp/verp.hpp"
#include "tests/host/libverp/expect_error.hpp"
#include "tests/host/libverp/opened.hpp"
#include "tests/support/leak.hpp"

namespace verp::abi::test {
namespace {

TEST(LibverpHostile, RotationsThatAreNone) {
  const verp_lib::Core core;
  float found[VERP_LEG_JOINTS];
  std::uint32_t flags = 0;
  const auto solve = [&](const std::array<float, 9>& rotation) {
    float sole[VERP_POSE] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.04F, -0.3F};
    std::copy_n(rotation.data(), 9, sole);
    return verp_core_leg_ik(core.handle(), 0, sole, nullptr, found, &flags);
  };
  const std::array<float, 9> wrong[] = {
      {2, 0, 0, 0, 2, 0, 0, 0, 2},      // scales
      {-1, 0, 0, 0, -1, 0, 0, 0, -1},   // mirrors
      {1, 0.01F, 0, 0, 1, 0, 0, 0, 1},  // shears
      {0, 0, 0, 0, 0, 0, 0, 0, 0},      // nothing
      {1e30F, 0, 0, 0, 1e30F, 0, 0, 0, 1e30F},
      {1.00051F, 0, 0, 0, 1, 0, 0, 0, 1},  // 0.00102 off
  };
  for (const auto& each : wrong) {
    expect_error(solve(each), VERP_BAD_ARGUMENT, "verp_core_leg_ik", "no rotation");
  }
  EXPECT_EQ(solve({1.00049F, 0, 0, 0, 1, 0, 0, 0, 1}), VERP_OK) << verp_last_error();
  EXPECT_EQ(solve({0.9848F, -0.1736F, 0, 0.1736F, 0.9848F, 0, 0, 0, 1}), VERP_OK)
      << verp_last_error() << ": 10 degrees, in four digits";
}

TEST(LibverpHostile, PlansThatAreTooLong) {
  const verp_lib::Core core;
  verp_plan one;
  expect_error(verp_core_plan(core.handle(), 0.1, 0, 0, &one, VERP_MOST_PLANNED + 1, 0),
               VERP_BAD_ARGUMENT, "verp_core_plan", "at most 1000000 ticks");
  expect_error(verp_core_plan(core.handle(), 0.1, 0, 0, nullptr, 1, 0), VERP_BAD_ARGUMENT,
               "verp_core_plan", "plan is null");
  expect_error(verp_core_plan(core.handle(), 0.1, 0, 0, &one, 1, 2), VERP_BAD_ARGUMENT,
               "verp_core_plan", "stop");
  EXPECT_TRUE(core.plan(0.1, 0, 0, 0).empty());
}

// The physics diverge.
TEST(LibverpHostile, APushBeyondAllNumbersIsInTheResult) {
  Opened opened;
  opened.add();
  ASSERT_EQ(verp_session_push(opened.session, "trunk", 1e300, 0, 0, 1), VERP_OK);
  {
    const verp::test::SomebodyElsesLeak ode_forgets_the_step_that_it_gave_up;
    ASSERT_LT(verp_session_tick(opened.session, 200, nullptr, nullptr), 0);
  }
  verp_result result = {};
  result.size = sizeof result;
  ASSERT_EQ(verp_session_result(opened.session, 0, &result), VERP_OK) << verp_last_error();
  EXPECT_NE(std::string(result.failure).find("physics diverged"), std::string::npos)
      << result.failure;
}

TEST(LibverpHostile, TextsThatAreEmpty) {
  Opened opened;
  verp_robot robot;
  ASSERT_EQ(verp_robot_defaults(&robot), VERP_OK);
  const auto add = [&](const char* verp_robot::*field, const std::string& why) {
    verp_robot wrong = robot;
    wrong.*field = "";
    expect_error(verp_session_add(opened.session, &wrong, nullptr), VERP_BAD_ARGUMENT,
                 "verp_session_add", why);
  };
  add(&verp_robot::model, "model is empty");
  add(&verp_robot::bus, "bus is empty");
  add(&verp_robot::name, "name is empty");
  add(&verp_robot::record, "record is empty");
  robot.flags = 2;
  expect_error(verp_session_add(opened.session, &robot, nullptr), VERP_BAD_ARGUMENT,
               "verp_session_add", "flags");
  opened.add();
  double value = 0;
  const auto session = opened.session;
  expect_error(verp_session_tune(session, 0, "", 1), VERP_BAD_ARGUMENT, "verp_session_tune",
               "name is empty");
  expect_error(verp_session_tuning(session, 0, "", &value), VERP_BAD_ARGUMENT,
               "verp_session_tuning", "name is empty");
  expect_error(verp_session_read(session, "", &value), VERP_BAD_ARGUMENT, "verp_session_read",
               "quantity is empty");
  expect_error(verp_session_set(session, "", 1), VERP_BAD_ARGUMENT, "verp_session_set",
               "quantity is empty");
  expect_error(verp_session_push(session, "", 1, 0, 0, 1), VERP_BAD_ARGUMENT, "verp_session_push",
               "thing is empty");
  expect_error(verp_replay("", nullptr, nullptr), VERP_BAD_ARGUMENT, "verp_replay",
               "file is empty");
  const verp_world world = {sizeof world, 0, ""};
  verp_session other = nullptr;
  expect_error(verp_session_open(&world, &other), VERP_BAD_ARGUMENT, "verp_session_open",
               "file is empty");
}

TEST(LibverpHostile, CoreTakesAnyBytes) {
  const verp_lib::Core core;
  std::mt19937 chance(1);
  verp_outputs outputs = {};
  for (int n = 0; n < 2000; ++n) {
    verp_inputs inputs = {};
    auto* const bytes = reinterpret_cast<unsigned char*>(&inputs);
    std::generate_n(bytes, sizeof inputs, [&] { return static_cast<unsigned char>(chance()); });
    if (n % 3 == 0) inputs.tick = static_cast<std::uint32_t>(n);
    if (n % 7 == 0) std::memset(&outputs, static_cast<int>(chance() & 0xff), sizeof outputs);
    ASSERT_EQ(verp_core_step(core.handle(), &inputs, &outputs), VERP_OK) << verp_last_error();
  }
  EXPECT_NE(core.digest(), 0U);
}

TEST(LibverpHostile, ManyThreadsOnOneHandle) {
  Opened opened;
  opened.add();
  opened.add([](verp_robot& robot) { robot.y_m = 1; });
  const verp_session session = opened.session;
  std::atomic<int> done = 0, told = 0;
  const auto work = [&](int which) {
    for (int n = 0; n < 100; ++n) {
      double value = 0;
      std::uint64_t digest = 0;
      const int status = which == 0   ? verp_session_tick(session, 1, nullptr, nullptr)
                         : which == 1 ? verp_session_digest(session, 1, &digest)
                         : which == 2 ? verp_session_emergency_stop(session, 0, n % 2)
                         : n < 60     ? verp_session_read(session, "world.time_s", &value)
                                      : verp_session_close(session);
      if (status >= 0) ++done;
      if (status == VERP_BUSY || status == VERP_BAD_HANDLE) ++told;
    }
  };
  std::vector<std::thread> threads;
  for (int which = 0; which < 4; ++which) threads.emplace_back(work, which);
  for (std::thread& each : threads) each.join();
  EXPECT_EQ(done + told, 400);
  EXPECT_GE(told, 39) << "closed, or busy, but for one";
}

/// It has C's messages.
TEST(LibverpHostile, CppNamesTheCall) {
  const auto says = [](const std::string& words, const std::function<void()>& call) {
    try {
      call();
      ADD_FAILURE() << "nothing was thrown, but '" << words << "' was to come";
    } catch (const verp_lib::Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(words, 0), 0U) << error.what();
      EXPECT_EQ(error.status, VERP_BAD_ARGUMENT);
    }
  };
  const auto cut = [](const char* text) { return std::string(text) + '\0' + "more"; };
  says("verp_core_open: model has a zero", [&] { verp_lib::Core core(cut("generic21")); });
  verp_lib::Session session;
  says("Session::seen: there is no robot 0", [&] { session.seen(); });
  session.add(verp_lib::Session::defaults());
  says("Session::seen: there is no robot 9", [&] { session.seen(9); });
  says("verp_session_tune: name has a zero", [&] { session.tune(cut("gait.lift_m"), 0.01); });
  says("verp_session_tuning: name has a zero", [&] { session.tuning(cut("gait.lift_m")); });
  says("verp_session_read: quantity has a zero", [&] { session.read(cut("trunk.mass_kg")); });
  says("verp_session_set: quantity has a zero", [&] { session.set(cut("trunk.mass_kg"), 1); });
  says("verp_session_push: thing has a zero", [&] { session.push(cut("trunk"), {1, 0, 0}, 1); });
  says("verp_replay: file has a zero", [&] { verp_lib::replay(cut("a")); });
  says("verp_session_render: view->width may be", [&] { session.render("front", ~0U, ~0U); });
  says("verp_session_render: view->width may be", [&] { session.render("front", 0, 48); });
  const verp_lib::Core core;
  says("verp_core_plan: count is 4294967295: at most", [&] { core.plan(0.1, 0, 0, ~0U); });
}

/// An exception belongs to the ticking thread, a moment to its controller's.
TEST(LibverpHostile, SecondThreadTakesNothingFromTheFirst) {
  verp_lib::Session session;
  session.add(verp_lib::Session::defaults());
  std::string told[2];
  session.control([&](const verp_lib::Moment& moment) {
    const auto attempt = [](std::string& words, const std::function<void()>& call) {
      std::thread([&] {
        try {
          call();
        } catch (const std::exception& error) {
          words = error.what();
        }
      }).join();
    };
    attempt(told[0], [&] { session.tick(); });
    attempt(told[1], [&] { moment.decide(); });
    throw std::out_of_range("mine");
  });
  EXPECT_THROW(session.tick(), std::out_of_range);
  EXPECT_EQ(told[0].rfind("verp_session_tick: another thread", 0), 0U) << told[0];
  EXPECT_EQ(told[1].rfind("verp_decide: that moment is in the hands of", 0), 0U) << told[1];
}

}  // namespace
}  // namespace verp::abi::test
