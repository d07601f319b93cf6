#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "common/model/tuning_ranges.hpp"
#include "host/os/files/places.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using Usage = Program;

TEST_F(Usage, HelpGoesToStdoutAndIsGood) {
  for (const char* arguments : {"--help", "walk --help", "trace export --help"}) {
    const Outcome outcome = verp(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_NE(outcome.out.find("Usage:"), std::string::npos) << arguments;
    EXPECT_EQ(outcome.err, "") << arguments;
  }
}

// ./verp --help prints it without a build.
TEST_F(Usage, TheLaunchersHelpIsThePrograms) {
  EXPECT_EQ(verp("--help").out, slurp(files::source_dir() / "host/apps/tool/help.txt"))
      << "mend it: build/host-release/host/apps/tool/verp --help > host/apps/tool/help.txt";
}

// Before the trace is read; no file is written.
TEST_F(Usage, APageIsNamedAsBrowsersWantIt) {
  expect_refused("replay none.mcap --page p.txt", "--page p.txt: a browser");
  expect_refused("replay none.mcap --page p", ".html");
  EXPECT_FALSE(fs::exists(folder_ / "p.txt"));
}

TEST_F(Usage, LinesOfHelpAreWholeCommandsAndAsWideAsTheTerminal) {
  const Outcome outcome = shell("COLUMNS=48 " VERP_PROGRAM " bus read --help");
  EXPECT_NE(outcome.out.find("\nUsage: verp bus read [OPTIONS]"), std::string::npos) << outcome.out;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const bool one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
    EXPECT_TRUE(line.size() <= 48 || one_word) << line;
  }
  // Only spaces and line ends differ.
  const auto words = [](std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    return text;
  };
  EXPECT_EQ(words(outcome.out), words(shell("COLUMNS=400 " VERP_PROGRAM " bus read --help").out));
}

// One list of choices is longer.
TEST_F(Usage, HelpFitsATerminalOfFortyColumns) {
  for (const char* word : {"walk", "run", "hil", "tune", "bus bench", "identify"}) {
    std::istringstream help(
        shell(std::string("COLUMNS=40 ") + VERP_PROGRAM + " " + word + " --help").out);
    for (std::string line; std::getline(help, line);)
      EXPECT_LE(line.size(), 40u) << word << ": " << line;
  }
}

TEST_F(Usage, TheRobotIsNamedByTheSameWordsEverywhere) {
  for (const char* command : {"check", "parameters", "bus load", "bus checklist"}) {
    const Outcome first = verp(std::string(command) + " generic21");
    EXPECT_EQ(first.status, 0) << command << first.err;
    EXPECT_EQ(verp(std::string(command) + " --robot generic21").out, first.out) << command;
    expect_refused(std::string(command) + " no_such_robot", "no_such_robot");
  }
}

TEST_F(Usage, EveryNumberOfTheTuningIsListedWithUnitAndRange) {
  const auto rows = nlohmann::json::parse(verp("parameters --json").out).at("parameters");
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kTuningCount));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const int id = model::tuning_id(row.at("name")).value_or(-1);
    ASSERT_EQ(id, static_cast<int>(i));
    EXPECT_TRUE(in_range(id, row.at("value").get<float>())) << row;
    EXPECT_EQ(row.at("low").get<float>(), kTuningRanges[i].low);
    EXPECT_EQ(row.at("high").get<float>(), kTuningRanges[i].high);
    EXPECT_EQ(row.at("name").get<std::string>().ends_with("_m"), row.at("unit") == "m") << row;
  }
}

TEST_F(Usage, UnknownWordsGetAHint) {
  expect_refused("", "subcommand");
  expect_refused("wlak", "did you mean walk?");
  expect_refused("walk --stpe 0.04", "did you mean --step?");
  expect_refused("walk --stpe=0.04", "did you mean --step?");
  expect_refused("walk --vel 0.1,0,0", "did you mean --velocity?");  // --help is further off
  expect_refused("replay --jsn x", "did you mean --json?");
}

TEST_F(Usage, NumbersAreCheckedAndTheRangeIsTold) {
  expect_refused("walk --step nan", "give 0 to 0.15 m");
  expect_refused("walk --step inf", "give 0 to 0.15 m");
  expect_refused("walk --step -0.04", "give 0 to 0.15 m");
  expect_refused("walk --step 4", "give 0 to 0.15 m");
  expect_refused("walk --step 0.04x", "give 0 to 0.15 m");
  expect_refused("walk --step 0,04", "give 0 to 0.15 m");
  expect_refused("walk --cycle 0", "0.3 to 2 s");
  expect_refused("walk --for -1", "3 to 86400 s");
  expect_refused("walk --for 1e300", "3 to 86400 s");
  expect_refused("walk --seed -1", "--seed");
  expect_refused("walk --seed 1.5", "--seed");
  expect_refused("walk --seed 1e3", "'1e3' is not a whole number in digits; give 0 to 4294967295");
  expect_refused("walk --seed 4294967296", "give 0 to 4294967295");
  expect_refused("bench --repetitions 1e1", "give 1 to 100");
}

TEST_F(Usage, ValuesThatAreMissingOrTooManyAreToldInWords) {
  expect_refused("walk --step", "--step needs a value");
  expect_refused("walk --for 3 --for 4", "--for is given more than once");
  expect_refused("check generic21 --json=no", "--json takes no value");
}

// An unset variable must not mean the default.
TEST_F(Usage, EmptyWordsAreRefused) {
  for (const char* option :
       {"--velocity", "--sweep-step", "--record", "--report", "--on", "--set"}) {
    const std::string remedy = std::string("after ") + option + " is empty; give a value or leave";
    expect_refused(std::string("walk ") + option + " ''", remedy);
    expect_refused(std::string("walk ") + option + "=", remedy);
  }
  for (const char* command : {"walk", "check", "replay", "diff a.mcap", "trace info"}) {
    expect_refused(std::string(command) + " ''", "is empty; give a value or leave it out");
  }
  expect_refused("export generic21 -o ''", "after -o is empty");
  expect_refused("trace export a.mcap -o ''", "after -o is empty");
  expect_refused("''", "after verp is empty");
}

TEST_F(Usage, ListsAreChecked) {
  expect_refused("walk --velocity 0.1", "VX,VY,WZ");
  expect_refused("walk --velocity 0.1,nan,0", "VY");
  expect_refused("walk --velocity 0.1,0,99", "rad/s");
  expect_refused("walk --seeds 5-1", "goes down");
  expect_refused("walk --sweep-step 0.02:0.06", "FROM:TO:BY");
  expect_refused("walk --sweep-step 0.06:0.02:0.01", "TO");
  expect_refused("walk --sweep-step 0.02:0.06:0", "BY");
  expect_refused("walk --sweep-step 0:0.15:0.001", "raise BY");
  expect_refused("walk --sweep-step 0.02:0.04:0.02 --velocity 0.1,0,0", "excludes");
}

TEST_F(Usage, WhoStandsDoesNotWalk) {
  expect_refused("walk --stand --velocity 0.1,0,0", "excludes");
  expect_refused("walk --stand --step 0.04", "excludes");
  expect_refused("walk --step 0.04 --velocity 0.1,0,0", "excludes");
  expect_refused("walk --stand --sweep-step 0.02:0.04:0.02", "excludes");
}

TEST_F(Usage, MapsAreOfOneRobotAndOfWalksOfTheirOwn) {
  expect_refused("walk --map moon", "--map: moon not in {push,stand,stability}");
  for (const char* other :
       {"--seeds 1-2", "--sweep-step 0.02:0.04:0.02", "--record a.mcap", "--on mps2_an386",
        "--push '1: trunk 0,1,0 N for 0.1'", "--get-up", "--start lying:front", "--cameras"}) {
    expect_refused(std::string("walk --map push ") + other, "excludes");
  }
  expect_refused("walk --map-grid 8", "requires --map");
  expect_refused("walk --map push --map-grid 37", "give 1 to 36 directions");
  expect_refused("walk --map push --for 5", "raise --for");
  expect_refused("walk --map stand --stand", "excludes");
  expect_refused("walk --map stand --for 5", "does not walk");
  expect_refused("walk --map stand --map-grid 37", "give 1 to 36 directions");
  expect_refused("walk --map stability --map-grid 4", "give an odd number");
  expect_refused("walk --map stability --velocity 0.1,0,0", "leave --velocity and --step out");
  expect_refused("walk --map stability --world demo --report /proc/no", "/proc/no");
}

TEST_F(Usage, ParametersAreCheckedByNameAndRange) {
  expect_refused("walk --set gait.lift=0.01", "gait.lift_m");
  expect_refused("walk --set lift_m=0.03", "did you mean gait.lift_m?");
  expect_refused("walk --set nonsense=1", "`verp parameters` lists them");
  expect_refused("walk --set hip_heigth=0.1", "did you mean gait.hip_height_m?");
  expect_refused("walk --set gait.hip_height_m=0.9", "the legs cannot stand level");
  expect_refused("check", "MODEL is required");
  expect_refused("walk --set gait.stance=0.03", "did you mean gait.half_stance_m?");
  expect_refused("walk --set ankle_roll=0",
                 "balance.ankle_roll_tilt or balance.ankle_roll_rate_s?");
  expect_refused("walk --set gait.lift_m", "NAME=VALUE");
  expect_refused("walk --set gait.lift_m=", "give 0 to 0.06\n");
  expect_refused("walk --set gait.lift_m=nan", "not a number");
  expect_refused("walk --set gait.lift_m=9", "out of range");
  expect_refused("walk --set gait.joint_delay_s=0.0301", "give 0 to 0.03");
  expect_refused("walk --set gait.cycle_s=0.5", "--cycle");
}

// 0.03 as a float is not 0.03 as a double.
TEST_F(Usage, BothEndsOfARangeAreInsideIt) {
  // The tuned gait falls with 0.03.
  EXPECT_NE(verp("walk --set gait.joint_delay_s=0.03 --for 3 --json").status, 2);
  EXPECT_EQ(verp("walk --set gait.joint_delay_s=0.02 --for 3 --json").status, 0);
  EXPECT_EQ(verp("walk --set safety.fall_tilt_rad=0.2 --for 3 --json").status, 0);
}

TEST_F(Usage, MissingAndMalformedFilesAreNamed) {
  expect_refused("walk no_such_robot", "no_such_robot");
  expect_refused("check no_such.sdf", "no_such.sdf");
  expect_refused("replay none.mcap", "none.mcap");
  expect_refused("diff none.mcap none.mcap", "none.mcap");
  expect_refused("trace info none.mcap", "none.mcap");
  std::ofstream(folder_ / "bad.sdf") << "<sdf version='1.9'><model name='a'>";
  expect_refused("walk bad.sdf", "bad.sdf");
  expect_refused("check bad.sdf", "bad.sdf");
  expect_refused("replay bad.sdf", "wrong magic");
}

TEST_F(Usage, FoldersAndNamesAreCalledWhatTheyAre) {
  for (const char* command : {"check", "walk", "export -o out"}) {
    expect_refused(std::string(command) + " /tmp", "/tmp: is a folder, not a robot's file; give");
  }
  expect_refused("check .", ".: is a folder");
  expect_refused("check /dev/null", "/dev/null: is not a regular file; give");
  expect_refused("walk nosuchrobot:1:", "nosuchrobot:1:: there is no robot of this name; give");
  expect_refused("walk nosuchrobot", "nosuchrobot: there is no robot of this name; give");
  expect_refused("replay /tmp", "/tmp: is a folder; name the .mcap file");
  expect_refused("replay none.mcap", "none.mcap: no such file");
  std::ofstream(folder_ / "file") << "x";
  expect_refused("export generic21 -o file", "file: not a folder");
}

TEST_F(Usage, UnwritablePlacesAreNamedBeforeTheRun) {
  expect_refused("walk --record missing/run.mcap", "missing/run.mcap");
  std::ofstream(folder_ / "file") << "x";
  expect_refused("walk --report file", "file");
}

// libsdformat would log to ~/.sdformat, or complain.
TEST_F(Usage, LibrariesPrintNothingAndLeaveNothingAtHome) {
  for (const char* home : {"env -u HOME ", "HOME=/proc ", "HOME=/nowhere ", "HOME=$PWD "}) {
    const Outcome outcome = shell(home + std::string(VERP_PROGRAM " check generic21"));
    EXPECT_EQ(outcome.status, 0) << home;
    EXPECT_EQ(outcome.err, "") << home;
  }
  EXPECT_FALSE(fs::exists(folder_ / ".sdformat"));
}

TEST_F(Usage, DevicesAndPipesAreNotReplacedByTraces) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  expect_refused("walk --record pipe", "not a regular file");
  expect_refused("replay pipe", "not a regular file");
  EXPECT_TRUE(fs::is_fifo(folder_ / "pipe"));
}

TEST_F(Usage, AnAnswerThatCannotBeWrittenIsAFailure) {
  const Outcome outcome = shell(VERP_PROGRAM " check generic21 > /dev/full");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
}

TEST_F(Usage, JsonErrorsAreOneObject) {
  const Outcome outcome = verp("replay none.mcap --json");
  EXPECT_EQ(outcome.status, 2);
  const auto said = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(said.at("exit"), 2);
  EXPECT_NE(said.at("error").get<std::string>().find("none.mcap"), std::string::npos);
}

TEST_F(Usage, VersionIsJsonWhenJsonIsAsked) {
  for (const char* arguments : {"--version --json", "--json --version"}) {
    const Outcome outcome = verp(arguments);
    EXPECT_EQ(outcome.status, 0) << arguments;
    EXPECT_TRUE(nlohmann::json::parse(outcome.out).contains("source_revision")) << arguments;
  }
  EXPECT_EQ(verp("--version").out.substr(0, 5), "verp ");
}

TEST_F(Usage, UnknownBoardIsBadUsageAndTheBoardsAreListed) {
  for (const char* board : {"nonesuch", "olimex_h405", "qemu_rv32", "zcu102_r5"}) {
    expect_refused(std::string("walk --on ") + board,
                   "give one of: mps2_an385, mps2_an386, mps2_an500, mps3_an547;");
  }
}

TEST_F(Usage, ABoardWithoutItsImageIsBadInputEverywhere) {
  ::setenv("VERP_FIRMWARE_DIR", folder_.c_str(), 1);
  for (const char* command :
       {"walk --on mps2_an386", "flash --board mps2_an386", "flash --board olimex_h405",
        "flash --board olimex_h405 --emulate", "flash --board olimex_h405 --dry-run",
        "flash --board olimex_h405 --bus can", "flash --board olimex_h405 --bus can --emulate"}) {
    expect_refused(command, "cmake --preset fw-");
  }
  ::unsetenv("VERP_FIRMWARE_DIR");
}

// The controller reads it.
TEST_F(Usage, AnImuThatIsNoDeviceOfTheBusIsShownWithoutAnId) {
  const std::string robot = fs::absolute(model::find_model("generic21")).string();
  const std::string other = "sed 's/sensor=\"imu\" id=\"120\"/sensor=\"imu\" id=\"0\"/' " + robot;
  const Outcome outcome = shell(other + " >own.sdf && " VERP_PROGRAM " check own.sdf");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("IMU (not on the bus) on "), std::string::npos) << outcome.out;
  EXPECT_NE(verp("check generic21").out.find("IMU (bus id 120) on "), std::string::npos);
}

}  // namespace
}  // namespace verp::tool::test
