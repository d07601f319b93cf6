#pragma once
#include <gtest/gtest.h>

#include <functional>

#include "host/apps/libverp/verp.h"
#include "tests/host/session/plans.hpp"

namespace verp::abi::test {

struct Opened {
  explicit Opened(const char* world = nullptr) {
    const verp_world what = {sizeof what, 0, world};
    EXPECT_EQ(verp_session_open(&what, &session), VERP_OK) << verp_last_error();
  }
  ~Opened() { verp_session_close(session); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  void add(const std::function<void(verp_robot&)>& change = {}) {
    verp_robot robot;
    ASSERT_EQ(verp_robot_defaults(&robot), VERP_OK);
    robot.walk_s = session::test::kWalk_s;
    robot.vx_m_s = 0.1;
    if (change) change(robot);
    ASSERT_EQ(verp_session_add(session, &robot, nullptr), VERP_OK) << verp_last_error();
  }
  void run() {
    int status = VERP_OK;
    while (status == VERP_OK) status = verp_session_tick(session, 100, nullptr, nullptr);
    ASSERT_EQ(status, VERP_OVER) << verp_last_error();
  }
  verp_result result() {
    verp_result result = {};
    result.size = sizeof result;
    EXPECT_EQ(verp_session_result(session, 0, &result), VERP_OK) << verp_last_error();
    return result;
  }

  verp_session session = nullptr;
};

}  // namespace verp::abi::test
