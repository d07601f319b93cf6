#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

void expect_walks(const char* model) {
  const Walk result = walk(std::string(model) + " --for 20 --physics-step 2");
  expect_walked(result);
  expect_between(1.5, number(result, "ahead_m"), 4.0, "way ahead, m");
}

TEST(ThirdParty, Op3Walks) {
  expect_walks("op3");
}

// Four seeds: joint zeros and accelerometer move the bias by 2 mm.
TEST(ThirdParty, Op3WalksWithItsZmpUnderItsSoles) {
  double sum_mm = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const Walk minute = walk("op3 --for 60 --seed " + std::to_string(seed));
    expect_walked(minute);
    sum_mm += number(minute, "zmp_bias_mean_mm");
  }
  expect_between(2.0, sum_mm / 4, 15.0, "mean ZMP bias, mm");
}

// Without foot sensors. Seed 1 once limped with 32 mm.
TEST(ThirdParty, Op3LearnsItsZeros) {
  const double learnt_mm = number(walk("op3 --for 20 --physics-step 2"), "zmp_bias_mean_mm");
  EXPECT_LT(learnt_mm,
            0.7 * number(walk("op3 --for 20 --physics-step 2 --no-zeros"), "zmp_bias_mean_mm"));
}

TEST(ThirdParty, DarwinOpWalks) {
  expect_walks("darwin_op");
}

// Asked for nothing, they go steps of gait.max_step_m.
TEST(ThirdParty, DucksWalkWithoutAnkleRoll) {
  for (const char* const duck : {"microduck", "open_duck"}) {
    const Walk result = walk(std::string(duck) + " --for 20 --physics-step 2");
    expect_walked(result);
    expect_between(0.05, number(result, "speed_mean_m_s"), 0.15, duck);
  }
}

// Knees bent the wrong way at zero, axes that do not meet, one motor for both hip yaws, fingers,
// massless links, no gait, gains or pose.
TEST(ThirdParty, OddRobotWalksFromTheLeastWrapper) {
  const Walk result =
      walk(VERP_SOURCE_DIR "/tests/host/model/odd_robot/robot.sdf --for 30 --physics-step 2");
  expect_walked(result);
  expect_between(2.5, number(result, "ahead_m"), 6.5, "way ahead, m");
  EXPECT_EQ(result.result.value("notes", "").find("out of reach"), std::string::npos);
}

std::string odd_robot(const std::string& name,
                      const std::vector<std::pair<std::string, std::string>>& changes) {
  namespace fs = std::filesystem;
  const fs::path from = VERP_SOURCE_DIR "/tests/host/model/odd_robot";
  const fs::path to = fs::path(testing::TempDir()) / name;
  fs::create_directories(to);
  fs::copy_file(from / "robot.sdf", to / "robot.sdf", fs::copy_options::overwrite_existing);
  std::stringstream text;
  text << std::ifstream(from / "odd.urdf").rdbuf();
  std::string urdf = text.str();
  for (const auto& [old_text, new_text] : changes) {
    const std::size_t at = urdf.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    urdf.replace(at, old_text.size(), new_text);
  }
  std::ofstream(to / "odd.urdf") << urdf;
  return (to / "robot.sdf").string();
}

// Hip axes 23 mm apart.
TEST(ThirdParty, WalksWithHipAxesThatAreFarApart) {
  const auto lower = [](const char* side) {
    const std::string thigh = std::string("<child link=\"") + side + "_thigh\"/><origin xyz=\"";
    return std::pair{thigh + "0.01 0 0", thigh + "0.01 0 -0.023"};
  };
  const Walk result = walk(odd_robot("apart", {lower("l"), lower("r")}) +
                           " --velocity 0.2,0,0 --for 20 --physics-step 2");
  expect_walked(result);
  expect_between(0.19, number(result, "speed_steady_m_s"), 0.21, "steady speed, m/s");
}

// Hip axes lean by 45 degrees on one motor, as in NAO.
TEST(ThirdParty, WalksAndTurnsWithLeaningHipAxesOnOneMotor) {
  const std::string left = "0.037 -0.085\"/>\n    <axis xyz=\"";
  const std::string right = "-0.037 -0.085\"/>\n    <axis xyz=\"";
  const std::string robot =
      odd_robot("leaning", {{" " + left + "0 0 1", " " + left + "0 0.70710678 0.70710678"},
                            {right + "0 0 1", right + "0 -0.70710678 0.70710678"}});
  const Walk ahead = walk(robot + " --velocity 0.2,0,0 --for 20 --physics-step 2");
  expect_walked(ahead);
  expect_between(0.19, number(ahead, "speed_steady_m_s"), 0.21, "steady speed, m/s");
  expect_walked(walk(robot + " --velocity 0.1,0,0.3 --for 20 --physics-step 2"));
  // Light rotors or stiff gears once diverged within 0.2 s.
  for (const char* seed : {"20", "26"})
    expect_walked(walk(robot + " --vary --for 3 --physics-step 2 --seed " + seed));
}

// 24 V, and 5 V for small servos: no input voltage error.
TEST(ThirdParty, WalksOnTheSupplyThatItsServosAreMadeFor) {
  std::stringstream text;
  text << std::ifstream(VERP_SOURCE_DIR "/common/robots/generic21/robot.sdf").rdbuf();
  for (const char* volts : {"24", "5"}) {
    std::string robot = text.str();
    const std::string usual = "type=\"xm430_w210\"", bus = "<verp:bus ";
    for (auto at = robot.find(usual); at != std::string::npos; at = robot.find(usual)) {
      robot.replace(at, usual.size(), "type=\"mine\"");
    }
    robot.insert(robot.find(bus),
                 std::string("<verp:servo_type name=\"mine\" like=\"xm430_w210\" nominal_v=\"") +
                     volts +
                     "\" stall_torque_n_m=\"3\" no_load_rev_min=\"77\" stall_current_a=\"2.3\" "
                     "source=\"the same strength\"/>");
    const std::string file = testing::TempDir() + "supply_" + volts + ".sdf";
    std::ofstream(file) << robot;
    SCOPED_TRACE(file);
    const Walk walked = walk(file + " --for 6 --physics-step 2");
    expect_walked(walked);
    expect_between(0.170, number(walked, "speed_steady_m_s"), 0.190, "steady speed, m/s");
  }
}

}  // namespace
}  // namespace verp::scenario
