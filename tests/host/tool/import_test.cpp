#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

class Import : public Program {
 protected:
  Import() {
    fs::copy_file(fs::path(VERP_SOURCE_DIR) / "tests/host/model/odd_robot/odd.urdf",
                  folder_ / "odd.urdf");
  }
};

TEST_F(Import, ForeignRobotWalksFromItsUntouchedFile) {
  const std::string before = slurp(folder_ / "odd.urdf");
  const Outcome made = verp("import odd.urdf");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("try `verp walk odd_verp/robot.sdf`"), std::string::npos) << made.out;
  EXPECT_NE(
      slurp(folder_ / "odd_verp" / "import.md").find("| left sole | 104 by 66 mm under l_foot"),
      std::string::npos);
  const Outcome walked = verp("walk odd_verp/robot.sdf --for 8");
  EXPECT_EQ(walked.status, 0) << walked.out << walked.err;
  EXPECT_EQ(slurp(folder_ / "odd.urdf"), before);
}

/// Where the program that draws is not installed.
TEST_F(Import, PageSaysWhyItHasNoPicture) {
  const fs::path robot = fs::path(VERP_PROGRAM).parent_path() / "verp_robot";
  fs::copy_file(robot, folder_ / "verp_robot");
  const Outcome made = shell("./verp_robot import odd.urdf");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(slurp(folder_ / "odd_verp" / "import.md")
                .find("There is no picture: verp_pictures is not built; `./verp shot --help`"),
            std::string::npos);
}

TEST_F(Import, TerminalIsAskedForTheServos) {
  const std::string program = std::string(VERP_PROGRAM) + " import odd.urdf -o ";
  const auto on_terminal = [&](const std::string& typed, const std::string& words) {
    std::ofstream(folder_ / "typed") << typed;
    const std::string line = "cd " + folder_.string() + " && script -qec '" + program + words +
                             "' said < typed > /dev/null 2>&1";
    return std::system(line.c_str());
  };
  EXPECT_EQ(on_terminal("nonesuch\nxm540_w270\n", "a"), 0);
  EXPECT_NE(slurp(folder_ / "said").find("no servo type 'nonesuch'"), std::string::npos);
  EXPECT_NE(slurp(folder_ / "a" / "robot.sdf").find("type=\"xm540_w270\""), std::string::npos);
  EXPECT_EQ(on_terminal("\n", "b"), 0);
  EXPECT_EQ(on_terminal("", "c --yes"), 0);
  EXPECT_EQ(slurp(folder_ / "b" / "robot.sdf"), slurp(folder_ / "c" / "robot.sdf"));
}

TEST_F(Import, MjcfBecomesUrdfOnce) {
  const std::string text =
      "<mujoco><worldbody><body name=\"b\"><geom size=\"0.1\"/></body></worldbody></mujoco>";
  std::ofstream(folder_ / "ball.xml") << text;
  expect_refused("import ball.xml -o new", "ball.xml: no leg is found");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  std::ofstream(folder_ / "ball_from_mjcf.urdf") << "mine";
  expect_refused("import ball.xml -o .", "ball_from_mjcf.urdf: is there already");
  EXPECT_EQ(slurp(folder_ / "ball_from_mjcf.urdf"), "mine");
  EXPECT_EQ(slurp(folder_ / "ball.xml"), text);
}

TEST_F(Import, ExportedRobotWalksAsFastWhenItComesBack) {
  const Outcome made = verp("export generic21 --mjcf out.xml");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("left out  gait, balance and safety parameters"), std::string::npos);
  ASSERT_EQ(verp("import out.xml -o back").status, 0);
  const auto speed = [&](const std::string& robot) {
    return nlohmann::json::parse(verp("walk " + robot + " --for 8 --json").out)
        .at("speed_steady_m_s")
        .get<double>();
  };
  EXPECT_NEAR(speed("back/robot.sdf") / speed("generic21"), 1, 0.02);
}

TEST_F(Import, ExportRefusesWhatItCannotWrite) {
  expect_refused("export generic21", "give -o FOLDER, --urdf FILE or --mjcf FILE");
  expect_refused("export generic21 --mjcf no/such/folder.xml", "no/such/folder.xml");
  expect_refused("export nonesuch --urdf out.urdf", "nonesuch");
}

TEST_F(Import, WrongFilesAndPlacesAreRefused) {
  ASSERT_EQ(verp("import odd.urdf -o here").status, 0);
  const std::string kept = slurp(folder_ / "here" / "robot.sdf");
  expect_refused("import odd.urdf -o here", "is there already");
  EXPECT_EQ(slurp(folder_ / "here" / "robot.sdf"), kept);
  expect_refused("import nothing.urdf -o other", "cannot read this file");
  expect_refused("import . -o other", "is a folder");
  expect_refused("import here/robot.sdf -o other", "this is a robot of VERP already");
  expect_refused("import odd.urdf -o odd.urdf/below", "cannot be made");
  expect_refused("import odd.urdf -o other --servos nonesuch", "no servo type 'nonesuch'");
  expect_refused("import nothing.urdf -o other/below", "cannot read this file");
  EXPECT_FALSE(fs::exists(folder_ / "other"));
  std::ofstream(folder_ / "import.md") << "mine";
  expect_refused("import odd.urdf -o .", "import.md: is there already");
  EXPECT_EQ(slurp(folder_ / "import.md"), "mine");
}

TEST_F(Import, AnInterruptedOneLeavesNothing) {
  for (const char* const at_s : {"0.1", "0.3", "0.6", "1"}) {
    shell(std::string("timeout -s INT ") + at_s + " " VERP_PROGRAM " import odd.urdf --yes -o it");
    for (const auto& each : fs::directory_iterator(folder_))
      EXPECT_FALSE(each.path().filename().string().starts_with("it.part")) << at_s;
    EXPECT_EQ(fs::exists(folder_ / "it"), fs::exists(folder_ / "it" / "import.md")) << at_s;
    fs::remove_all(folder_ / "it");
  }
  EXPECT_EQ(verp("import odd.urdf --yes -o it").status, 0);
}

}  // namespace
}  // namespace verp::tool::test
