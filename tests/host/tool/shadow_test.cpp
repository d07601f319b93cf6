#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/shadow/polled_controller.hpp"
#include "tests/host/tool/program.hpp"

// On an operator port; tests/can/shadow_test.cpp covers CAN.
namespace verp::shadow::test {
namespace {

using nlohmann::json;

class ShadowOnSerial : public tool::test::Program {
 protected:
  Params params() const {
    return model::make_params(model::load_robot(model::find_model("generic21")));
  }
  std::string port() const { return (folder_ / "port").string(); }
  tool::test::Outcome shadow(const std::string& arguments) const {
    return verp("shadow generic21 --json --link unix:" + port() + " " + arguments, "shadow");
  }
};

TEST_F(ShadowOnSerial, ComparesTheTicksThatItFetches) {
  Controller controller(params(), "unix-listen:" + port(), std::chrono::milliseconds(5));
  const auto outcome = shadow("--for 1");
  ASSERT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  const json result = json::parse(outcome.out);
  EXPECT_GE(result.at("compared_ticks"), 100);
  EXPECT_EQ(result.at("differs"), false);
}

TEST_F(ShadowOnSerial, NamesTickStageAndField) {
  Controller controller(params(), "unix-listen:" + port(), std::chrono::milliseconds(5));
  controller.spoil_when_read = true;
  const auto outcome = shadow("--for 60");
  ASSERT_EQ(outcome.status, 1) << outcome.err << outcome.out;
  const json difference = json::parse(outcome.out).at("difference");
  EXPECT_EQ(difference.at("tick"), controller.spoilt.load());
  EXPECT_EQ(difference.at("stage"), "kinematics");
  EXPECT_EQ(difference.at("field"), "zeros.leg[1].pitch_rad");
}

TEST_F(ShadowOnSerial, RefusesAnotherRobotAndAControllerThatIsNotThere) {
  {
    Params other = params();
    other.joint[3].zero_count += 1;
    Controller controller(other, "unix-listen:" + port(), std::chrono::milliseconds(5));
    const auto outcome = shadow("");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("drives another robot"), std::string::npos) << outcome.err;
  }
  const auto outcome = verp("shadow generic21 --patience 0.5 --link unix-listen:" + port());
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("no controller was heard"), std::string::npos) << outcome.err;
}

/// A CAN link selects the first CAN bus.
TEST_F(ShadowOnSerial, TakesTheBusThatTheLinkIsOn) {
  const auto outcome = verp("shadow generic21 --link can:verp_none0");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.err.find("speaks"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("can:verp_none0"), std::string::npos) << outcome.err;
  expect_refused("shadow generic21 --bus dxl --link can:verp_none0", "speaks dynamixel2");
  expect_refused("shadow op3 --link can:verp_none0", "speaks dynamixel2");
}

}  // namespace
}  // namespace verp::shadow::test
