#include "host/study/identify/motion.hpp"

#include <gtest/gtest.h>

#include "host/author/action/check.hpp"
#include "host/author/action/compile.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::identify {
namespace {

// `verp action check` must find nothing.
TEST(Motion, OfAnyRobotKeepsItsLinksApartAndItsServosWithinTheirLimits) {
  for (const char* name : {"op3", "darwin_op"}) {
    const model::Entity robot = model::load_robot(model::find_model(name));
    const Params params = model::make_params(robot);
    const action::CompiledActions made = action::make_library(params, {motion_of(robot)});
    const action::ActionCheck checked = action::check(robot, params, made, 1);
    EXPECT_GT(checked.length_s, 60) << name;
    const action::FrameCheck* bad = checked.first_bad();
    EXPECT_EQ(bad, nullptr) << name << ", frame " << bad->frame << ": " << bad->problem;
  }
}

}  // namespace
}  // namespace verp::identify
