#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using nlohmann::json;
using Scenarios = Program;

TEST_F(Scenarios, WalkAsTheCommandLinesThatPrintedThem) {
  const char* const lines[] = {
      "--for 3 --physics-step 2 --velocity 0.05,0,0.2 --seed 7 --set gait.lift_m=0.02 --cycle 0.5 "
      "--push '1: trunk 3,0,0 N for 0.1' --at '2: trunk.mass_kg=2.2' --no-gravity",
      "--for 3 --physics-step 2 --bus can --vary --seed 3 --stand",
      "--for 3 --physics-step 2 --robots 2 --world pitch",
  };
  for (const std::string line : lines) {
    const Outcome printed = verp("walk --print-scenario " + line + " >run.json");
    ASSERT_EQ(printed.status, 0) << printed.err;
    const Outcome typed = verp("walk --json " + line),
                  read = verp("walk --json --scenario run.json");
    json as_typed = json::parse(typed.out), as_read = json::parse(read.out);
    EXPECT_EQ(as_read.at("changed"), json::parse(R"([["--scenario", "run.json"]])"));
    for (json* each : {&as_typed, &as_read}) {
      each->erase("changed");
      each->erase("real_time_factor");
    }
    EXPECT_EQ(as_read, as_typed) << line;
    EXPECT_EQ(read.status, typed.status);
    EXPECT_EQ(verp("walk --print-scenario --scenario run.json").out, slurp(folder_ / "run.json"));
  }
}

TEST_F(Scenarios, AreRefusedWhereTheyAreWrong) {
  const auto write = [&](const std::string& text) {
    std::ofstream(folder_ / "wrong.json") << text;
  };
  expect_refused("walk --scenario none.json", "none.json: cannot be read");
  write(R"({"robots": [{"modle": "op3"}]})");
  expect_refused("walk --scenario wrong.json", "wrong.json: robots[0].modle: there is no such key");
  write(R"({"robots": [{"seed": "one"}]})");
  expect_refused("walk --scenario wrong.json", "wrong.json: robots[0].seed: \"one\" is not");
  write(R"({"robots": [{"disturbances": [{"at_s": 1, "push": "nobody", "for_s": 0.1}]}]})");
  expect_refused("walk --scenario wrong.json", "wrong.json: robots[0].disturbances[0]: ");
  expect_refused("walk --scenario wrong.json --seed 3",
                 "--seed says how the run is, and so does --scenario");
  expect_refused("walk --scenario wrong.json --seed 1", "--seed says how the run is");
  expect_refused("walk generic21 --scenario wrong.json", "generic21 says how the run is");
  write(R"({"length_s": 1e400})");
  expect_refused("walk --scenario wrong.json", "wrong.json: no JSON: number overflow");
}

TEST_F(Scenarios, AreRefusedWhereTheOptionsWouldBe) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "no JSON: the file is empty"},
      {R"({"world": {"physics_step_ms": 0.7}})", "world.physics_step_ms: give one of"},
      {R"({"world": {"file": "nope"}})", "world.file: nope: there is no world"},
      {R"({"robots": []})", "robots: 0 robots; give 1 to 16"},
      {R"({"robots": [{"model": "nope"}]})", "robots[0].model: nope: there is no robot"},
      {R"({"robots": [{"bus": "nope"}]})", "robot.sdf"},
      {R"({"robots": [{"name": "a b"}]})", "robots[0].name: a name has letters"},
      {R"({"robots": [{"seed": 4294967296}]})", "robots[0].seed: 4294967296 is out of range"},
      {R"({"robots": [{"name": "a"}, {"name": "a"}]})", "robots[1].name: robots[0] has it"},
      {R"({"robots": [{"name": "a"}, {"name": "b"}]})", "robots[1].at: robots[0] stands there"},
      {R"({"robots": [{"tuning": {"x": 1}}]})", "`verp parameters` lists them"},
      {R"({"robots": [{"controller": {"board": "nope"}}]})", "robots[0].controller.board: nope"},
      {R"({"robots": [{"controller": {"folder": "."}}]})", "robots[0].controller.folder: . has no"},
      {R"({"robots": [{"controller": {"board": "a", "link": "b"}}]})", "give one of board, link"},
  };
  for (const auto& [text, what] : cases) {
    std::ofstream(folder_ / "wrong.json") << text;
    expect_refused("walk --scenario wrong.json", "wrong.json: ");
    expect_refused("walk --scenario wrong.json", what);
  }
  std::ofstream(folder_ / "wrong.json") << "{}" << '\0' << "}";
  expect_refused("walk --scenario wrong.json", "wrong.json: no JSON: a byte is 0");
  expect_refused("walk --scenario .", "cannot be read");
}

TEST_F(Scenarios, AreRefusedOfManyRuns) {
  for (const char* many : {"--seeds 1-3", "--map push", "--sweep-step 0.01:0.03:0.01"})
    expect_refused(std::string("walk --print-scenario ") + many, "a scenario file holds one run");
}

}  // namespace
}  // namespace verp::tool::test
