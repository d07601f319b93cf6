#include <gtest/gtest.h>

#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/model/test_files.hpp"
#include "tests/unit/gait/soles.hpp"

namespace verp::model {
namespace {

TEST(SolesOfShippedRobots, PassBesideEachOtherHoweverOrdersJump) {
  for (const char* name : {"generic21", "op3", "darwin_op"}) {
    const Params params = make_params(load_robot(robot_file(name)));
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
      EXPECT_GT(gait::test::least_apart_of_jumps_m(params, params.tuning.gait, seed, 100), 0.001F)
          << name << ", seed " << seed;
    }
  }
}

TEST(SolesOfShippedRobots, PassBesideEachOtherInCurves) {
  for (const char* name : {"generic21", "op3", "darwin_op"}) {
    const Params params = make_params(load_robot(robot_file(name)));
    for (const float vx : {-0.2F, 0.1F, 0.25F, 0.4F}) {
      for (const float wz : {-1.5F, -0.7F, -0.3F, 0.3F, 0.7F, 1.0F, 1.5F}) {
        gait::FootstepState state;
        gait::Step step = gait::first_step(params, params.tuning.gait, state);
        for (int i = 0; i < gait::test::kSteps; ++i) {
          step = gait::next_step(params, params.tuning.gait, {.vx_m_s = vx, .wz_rad_s = wz}, step,
                                 state);
          ASSERT_GT(gait::test::least_apart_m(params, step), 0.001F)
              << name << ": " << vx << " m/s, " << wz << " rad/s";
        }
      }
    }
  }
}

}  // namespace
}  // namespace verp::model
