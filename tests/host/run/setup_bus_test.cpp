#include <fstream>

#include "tests/host/tool/program.hpp"

// With several buses. CAN drives need their maker's tool.
namespace verp::tool::test {
namespace {

using SetupBus = Program;

TEST_F(SetupBus, DrivesOnCanAreLeftToTheirMakersTool) {
  expect_refused("bus setup --link can:vcan0", "verp bus scan --link can:vcan0");
  expect_refused("bus setup --bus can --link serial:/dev/nothing", "their maker's tool");
  expect_refused("bus setup --bus can --link can:vcan0", "verp bus checklist generic21 --bus can");
}

TEST_F(SetupBus, AnotherBusHasAReportOfItsOwn) {
  std::string robot = slurp(VERP_SOURCE_DIR "/common/robots/generic21/robot.sdf");
  const std::size_t begin = robot.find("<verp:bus name=\"dxl\""), end = robot.find("</verp:bus>");
  ASSERT_LT(begin, end);
  std::string second = robot.substr(begin, end - begin) + "</verp:bus>\n";
  second.replace(second.find("dxl"), 3, "two");
  robot.insert(begin, second);  // now the first bus
  std::ofstream(folder_ / "robot.sdf") << robot;
  std::ofstream(folder_ / "generic21-setup.json") << "nothing";
  expect_refused("bus setup robot.sdf --link pty:", "generic21-setup.json: is no report");
  std::ofstream(folder_ / "generic21-dxl-setup.json") << "nothing";
  expect_refused("bus setup robot.sdf --bus dxl --link pty:", "generic21-dxl-setup.json: is no");
}

TEST_F(SetupBus, TheChecklistIsOfTheBusThatIsNamed) {
  const Outcome list = verp("bus checklist generic21 --bus can");
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_EQ(list.out.find("verp bus setup"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("verp bus scan"), std::string::npos) << list.out;
  expect_refused("bus checklist generic21 --bus nothing", "nothing");
}

}  // namespace
}  // namespace verp::tool::test
