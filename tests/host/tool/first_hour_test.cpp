#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/os/files/places.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using NewRobot = Program;
using nlohmann::json;

TEST_F(NewRobot, IsATableAndTheRobotMadeFromIt) {
  const Outcome made = verp("new robot my_bot --from generic21");
  ASSERT_EQ(made.status, 0) << made.err;
  const Outcome checked = verp("check my_bot");
  EXPECT_EQ(checked.status, 0) << "found in the working folder: " << checked.err;
  EXPECT_EQ(verp("check " + (folder_ / "my_bot/robot.sdf").string()).status, 0);

  const std::string before = slurp(folder_ / "my_bot/robot.sdf");
  ASSERT_EQ(shell("sed -i 's/^thigh_m = .*/thigh_m = 0.11/' my_bot/my_bot.table").status, 0);
  const Outcome again = verp("new robot my_bot");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(slurp(folder_ / "my_bot/robot.sdf"), before) << "made anew from the table";
  EXPECT_EQ(verp("check my_bot").status, 0);
}

TEST_F(NewRobot, WalksAtThePaceThatItsFileSays) {
  ASSERT_EQ(verp("new robot slow_bot --from generic21").status, 0);
  const std::string walk = "walk slow_bot --for 3 --physics-step 2 --json";
  const json usual = json::parse(verp(walk).out),
             slow = json::parse(verp(walk + " --cycle 0.6").out);
  const std::string pace = "<verp:tuning name=\"gait.cycle_s\" value=\"0.6\"/>";
  ASSERT_EQ(
      shell("sed -i '0,/<verp:tuning/s|<verp:tuning|" + pace + "&|' slow_bot/robot.sdf").status, 0);
  EXPECT_NE(usual.at("digest"), slow.at("digest"));
  EXPECT_EQ(json::parse(verp(walk).out).at("digest"), slow.at("digest"));
  EXPECT_EQ(json::parse(verp(walk + " --cycle 0.45").out).at("digest"), usual.at("digest"));
}

using NewTune = Program;

TEST_F(NewTune, RefusesWhatItCannotDo) {
  expect_refused("tune", "MODEL is required");
  expect_refused("tune nobody", "nobody");
  expect_refused("tune generic21 --speed 0", "--speed");
  std::ofstream(folder_ / "kept.sdf") << "mine";
  expect_refused("tune generic21 --write kept.sdf", "is there already");
  expect_refused("tune generic21 --write nowhere/tuned.sdf", "nowhere/tuned.sdf");
  const std::string odd = (files::source_dir() / "tests/host/model/odd_robot/robot.sdf").string();
  expect_refused("tune " + odd + " --write tuned.sdf", "write it beside");
  EXPECT_FALSE(fs::exists(folder_ / "tuned.sdf"));
}

TEST_F(NewRobot, StandsWhereItIsLookedFor) {
  const std::string path = "VERP_ROBOT_PATH=$PWD/none:$PWD/mine ";
  ASSERT_EQ(shell(path + VERP_PROGRAM " new robot other_bot --in mine").status, 0);
  EXPECT_EQ(shell(path + VERP_PROGRAM " check other_bot").status, 0);
  expect_refused("check other_bot", "there is no robot of this name");
  ASSERT_EQ(shell("VERP_ROBOT_PATH=$PWD/mine " VERP_PROGRAM " new robot third_bot").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/third_bot/robot.sdf"));
}

TEST_F(NewRobot, RefusesWhatItCannotMake) {
  expect_refused("new robot 'My Bot'", "small letters, digits");
  expect_refused("new robot a_name_that_is_longer_than_it_may_be", "up to 23");
  expect_refused("new robot my_bot --from nonesuch", "nonesuch");
  std::ofstream(folder_ / "bad.table") << "name = x\nthigh = 3\n";
  expect_refused("new robot my_bot --from bad.table", "is missing; add a line");
  fs::create_directories(folder_ / "kept");
  std::ofstream(folder_ / "kept/robot.sdf") << "mine";
  expect_refused("new robot op3", "there is a robot 'op3' already");
  expect_refused("new robot kept", "is not made from a table");
  EXPECT_EQ(slurp(folder_ / "kept/robot.sdf"), "mine");
}

using NewController = Program;

// tests/host/own builds and walks the project.
TEST_F(NewController, RefusesWhatItCannotLayOut) {
  for (const std::string name : {"3x", "'a b'", "a-b", "\xC3\xA4"})
    expect_refused("new controller " + name, "letters, digits and _");
  fs::create_directories(folder_ / "kept");
  expect_refused("new controller kept", "kept: is there already");
  std::ofstream(folder_ / "file") << "x";
  expect_refused("new controller mine --in file", "cannot be made");
  EXPECT_FALSE(fs::exists(folder_ / "mine"));
  expect_refused("walk --controller kept", "has no controller.hpp");
  expect_refused("walk --controller nowhere", "verp new controller NAME");
  expect_refused("flash --board mps2_an386 --controller nowhere", "has no controller.hpp");
  ASSERT_EQ(verp("new controller mine").status, 0);
  expect_refused("walk --controller mine --get-up", "no actions to get up by");
  expect_refused("flash --board nonesuch --controller mine", "no such board; give one of");
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == ',') {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

TEST_F(Program, ExportTellsWhatTheControllerMadeOfEachTick) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  std::istringstream csv(verp("trace export a.mcap").out);
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> names = cells(line);
  const auto column = [&](const char* name) {
    const auto found = std::find(names.begin(), names.end(), name);
    EXPECT_NE(found, names.end()) << name;
    return static_cast<std::size_t>(found - names.begin());
  };
  const std::size_t phase = column("gait_phase"), measured = column("rad.l_knee"),
                    goal = column("goal_rad.l_knee"), speed = column("rad_s.l_knee");
  double most_rad = 0, most_rad_s = 0;
  int walking = 0;
  while (std::getline(csv, line)) {
    const std::vector<std::string> row = cells(line);
    ASSERT_EQ(row.size(), names.size());
    if (row[phase] == "0") continue;
    ++walking;
    most_rad = std::max(most_rad, std::abs(std::stod(row[goal]) - std::stod(row[measured])));
    most_rad_s = std::max(most_rad_s, std::abs(std::stod(row[speed])));
  }
  EXPECT_GT(walking, 200);
  EXPECT_GT(most_rad, 0.001) << "a goal is not what became of it";
  EXPECT_LT(most_rad, 0.5);
  EXPECT_GT(most_rad_s, 0.5);
  EXPECT_NE(verp("trace export --state a.mcap").out.find(",state."), std::string::npos);
}

TEST_F(Program, TheShellKnowsTheWords) {
  const std::string ask = "eval \"$(" VERP_PROGRAM
                          " completion bash)\"; "
                          "tab() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($#-1)); _verp; "
                          "echo \"${COMPREPLY[@]}\"; }; ";
  const auto tab = [&](const std::string& words) {
    return shell("bash -c '" + ask + "tab " + words + "'").out;
  };
  EXPECT_EQ(tab("verp sha"), "shadow\n");
  EXPECT_EQ(tab("verp bus loa"), "load\n");
  EXPECT_EQ(tab("verp walk --sweep"), "--sweep-step\n");
  EXPECT_EQ(tab("verp check gener"), "generic21\n");
  EXPECT_EQ(tab("verp flash --board olim"), "olimex_h405\n");
  EXPECT_EQ(tab("verp test --fil"), "--filter\n");
  EXPECT_NE(verp("completion fish").out.find("-l sweep-step"), std::string::npos);
  EXPECT_NE(verp("completion zsh").out.find("bashcompinit"), std::string::npos);
  expect_refused("completion tcsh", "SHELL");
}

}  // namespace
}  // namespace verp::tool::test
