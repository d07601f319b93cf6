#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/host/run/lone_servo.hpp"
#include "tests/host/run/process.hpp"

namespace verp::tool::test {
namespace {

using Json = nlohmann::json;
using verp::test::LoneServo;
namespace at = dxl::address;

constexpr bus::ServoIdentity kFromTheBox{.id = 1, .model = dxl::kModelXm430W210, .baud = 57600};

class Setup : public Program {
 protected:
  std::unique_ptr<Process> setup(std::vector<std::string> more) {
    std::vector<std::string> words = {"bus", "setup", "generic21", "--link", "serial:" + port()};
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Process>(folder_, "setup", words);
  }
  std::string port() const { return (folder_ / "tty").string(); }
  Json report() const {
    return Json::parse(slurp(folder_ / "generic21-setup.json"), nullptr, false);
  }

  /// The user holds the servo at zero, where the encoder reads `zero`, and turns it by `turn`
  /// counts.
  void do_joint(Process& program, std::int32_t zero, std::int32_t turn) {
    ASSERT_TRUE(program.says("Connect its servo alone"));
    servos_.turn_to(zero);
    program.type("\n");
    ASSERT_TRUE(program.says("Zero: torque is off")) << program.wait().err;
    EXPECT_EQ(servos_.value(at::kTorqueEnable, 1), 0);
    program.type("\n");
    ASSERT_TRUE(program.says("Direction:")) << program.wait().err;
    servos_.turn_to(zero + turn);
    program.type("\n");
  }

  LoneServo servos_{port()};
};

// Id 14, direction +1, zero at 2048.
TEST_F(Setup, AServoOutOfItsBoxBecomesOneOfTheRobot) {
  servos_.connect(kFromTheBox);
  auto program = setup({"--joint", "l_knee", "--json"});
  do_joint(*program, 1900, 150);
  const Outcome outcome = program->wait();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(servos_.value(at::kId, 1), 14);
  EXPECT_EQ(servos_.value(at::kBaudRate, 1), dxl::baud_rate_code(2'000'000));
  EXPECT_EQ(servos_.value(at::kReturnDelay, 1), 0);
  EXPECT_EQ(servos_.value(at::kStatusReturnLevel, 1), 2);
  EXPECT_EQ(servos_.value(at::kHomingOffset, 4), 148);
  servos_.turn_to(1900);
  EXPECT_EQ(servos_.value(at::kPresentPosition, 4), 2048) << "zero is where the model has it";
  const Json joint = report().at("joints").at("l_knee");
  EXPECT_EQ(joint.at("outcome"), "done");
  EXPECT_EQ(joint.at("found"), (Json{{"id", 1}, {"baud", 57600}}));
  EXPECT_EQ(joint.at("zero").at("homing_after"), 148);
  EXPECT_EQ(joint.at("direction").at("right"), true);
  EXPECT_EQ(Json::parse(outcome.out).at("joints").at("l_knee"), joint);
}

TEST_F(Setup, AServoThatIsSetToSilenceIsHeard) {
  servos_.connect({.id = 77, .model = dxl::kModelXm430W210, .baud = 1'000'000});
  LoneServo& servos = servos_;
  ASSERT_EQ(servos.value(at::kStatusReturnLevel, 1), 2);
  ASSERT_EQ(verp("bus write --id 77 --register status_return_level 0 --link serial:" + port() +
                 "@1000000")
                .status,
            0);
  auto program = setup({"--joint", "l_knee"});
  do_joint(*program, 2048, 150);
  EXPECT_EQ(program->wait().status, 0);
  EXPECT_EQ(servos.value(at::kId, 1), 14);
  EXPECT_EQ(servos.value(at::kStatusReturnLevel, 1), 2);
  EXPECT_EQ(servos.value(at::kHomingOffset, 4), 0);
}

// An unknown delay is not zero.
TEST_F(Setup, ARunIsRefusedWhereNoReadIsAnswered) {
  servos_.connect({.id = 14, .model = dxl::kModelXm430W210, .baud = 2'000'000});
  const std::string link = " --link serial:" + port() + "@2000000";
  ASSERT_EQ(verp("bus write --id 14 --register status_return_level 0" + link).status, 0);
  const Outcome outcome = verp("run generic21 --yes" + link);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("device 14 answers a ping, but none of 10 reads"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(servos_.value(at::kTorqueEnable, 1), 0);
}

// The report names the model's new values.
TEST_F(Setup, AReversedJointAndAFarZeroAreLeftToThePerson) {
  servos_.connect(kFromTheBox);
  auto program = setup({"--joint", "l_knee"});
  do_joint(*program, 300, -20);
  ASSERT_TRUE(program->says("turn it further"));
  servos_.turn_to(150);
  program->type("\n");
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 1);
  const Json joint = report().at("joints").at("l_knee");
  EXPECT_EQ(joint.at("outcome"), "to do");
  const std::string todo = joint.at("todo");
  EXPECT_NE(todo.find("offset=\"300\""), std::string::npos) << todo;
  EXPECT_NE(todo.find("direction=\"-1\""), std::string::npos) << todo;
  EXPECT_EQ(servos_.value(at::kHomingOffset, 4), 0) << "it would not have counted";
  EXPECT_NE(outcome.out.find("to do: "), std::string::npos) << outcome.out;
}

TEST_F(Setup, GoesOnWhereItEnded) {
  servos_.connect(kFromTheBox);
  auto first = setup({});
  ASSERT_TRUE(first->says("head_yaw (1 of 21): id 19"));
  do_joint(*first, 2048, 200);
  ASSERT_TRUE(first->says("head_pitch (2 of 21)"));
  first->hang_up();
  const Outcome ended = first->wait();
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find("the same command goes on from here"), std::string::npos) << ended.err;
  EXPECT_EQ(report().at("joints").size(), 1u);
  auto second = setup({});
  ASSERT_TRUE(second->says("Connect its servo alone"));
  second->type("s\n");
  ASSERT_TRUE(second->says("head_roll (3 of 21)"));
  second->signal(SIGINT);
  const Outcome interrupted = second->wait();
  EXPECT_EQ(interrupted.status, 130);
  EXPECT_EQ(interrupted.err.find("head_yaw ("), std::string::npos) << "it was done";
  EXPECT_NE(interrupted.out.find("head_yaw          done"), std::string::npos) << interrupted.out;
  EXPECT_EQ(report().at("joints").at("head_pitch").at("outcome"), "skipped");
}

// The user leaves in three ways; the next run adds to the report.
TEST_F(Setup, WhatWasWrittenIsKeptAtOnce) {
  struct End {
    void (*leave)(Process&);
    int status;
  };
  const auto ends = {End{[](Process& p) { p.type("q\n"); }, 1},
                     End{[](Process& p) { p.hang_up(); }, 1},
                     End{[](Process& p) { p.signal(SIGINT); }, 128 + SIGINT}};
  const Json delay = {{"register", "return_delay"}, {"before", 250}, {"after", 0}};
  const auto has_delay = [&] {
    const Json changes = report()["joints"]["l_knee"]["changes"];
    return std::count(changes.begin(), changes.end(), delay);
  };
  for (const End& end : ends) {
    servos_.disconnect();
    servos_.connect(kFromTheBox);
    servos_.turn_to(2000);
    fs::remove(folder_ / "generic21-setup.json");
    auto program = setup({"--joint", "l_knee"});
    ASSERT_TRUE(program->says("Connect its servo alone"));
    program->type("\n");
    ASSERT_TRUE(program->says("Zero: torque is off"));
    end.leave(*program);
    const Outcome outcome = program->wait();
    EXPECT_EQ(outcome.status, end.status) << outcome.err;
    EXPECT_EQ(servos_.value(at::kReturnDelay, 1), 0);
    EXPECT_EQ(outcome.out.find("nothing was written"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("generic21-setup.json"), std::string::npos) << outcome.out;
    ASSERT_EQ(has_delay(), 1) << report().dump();
    EXPECT_EQ(report()["joints"]["l_knee"]["outcome"], "begun");
  }
  auto next = setup({"--joint", "l_knee"});
  ASSERT_TRUE(next->says("Connect its servo alone"));
  next->type("s\n");
  EXPECT_EQ(next->wait().status, 1);
  EXPECT_EQ(has_delay(), 1) << "skipped, not forgotten";
  auto last = setup({"--joint", "l_knee"});
  do_joint(*last, 2000, 150);
  EXPECT_EQ(last->wait().status, 0);
  EXPECT_EQ(has_delay(), 1);
  EXPECT_EQ(report()["joints"]["l_knee"]["changes"].back()["register"], "homing_offset");
  EXPECT_EQ(report()["joints"]["l_knee"]["outcome"], "done");
}

// The user held a joint for each result.
TEST_F(Setup, WhatAFullDiskDoesNotTakeIsPrinted) {
  const Json before = {{"robot", "generic21"},
                       {"joints", {{"head_yaw", {{"note", std::string(20000, '.')}}}}}};
  std::ofstream(folder_ / "generic21-setup.json") << before.dump();
  servos_.connect(kFromTheBox);
  servos_.turn_to(1900);
  auto program = setup({"--joint", "l_knee"});
  ASSERT_TRUE(program->says("Connect its servo alone"));
  program->type("\n");
  ASSERT_TRUE(program->says("Zero: torque is off"));
  program->fill_disk(8192);
  program->type("\n");
  program->hang_up();
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 2);
  const std::size_t at = outcome.err.find("not in the report: {\"l_knee\"");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("\"homing_after\":148", at), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot be written: File too large", at), std::string::npos);
  EXPECT_EQ(report()["joints"]["head_yaw"], before["joints"]["head_yaw"]);
  EXPECT_EQ(report()["joints"]["l_knee"]["outcome"], "begun") << "as it was kept last";
  EXPECT_EQ(shell("ls *.part *.trial").out, "");
}

TEST_F(Setup, PlacesThatHoldNoReportAreRefusedFirst) {
  for (const char* place : {"/proc/x.json", "/tmp", "/proc/self/mem", "/dev/full"}) {
    const std::string words = std::string("bus setup --link unix:none --report ") + place;
    expect_refused(words, std::string(place) + ": ");
  }
  for (const char* place : {"/tmp", "/proc/self/mem", "/dev/full"}) {
    expect_refused(std::string("bus setup --link unix:none --dry-run --report ") + place,
                   std::string(place) + ": ");
  }
  const Outcome full =
      shell("ulimit -f 8; " VERP_PROGRAM " bus setup --link unix:none --report x.json");
  EXPECT_EQ(full.status, 2) << full.err;
  EXPECT_NE(full.err.find("x.json: cannot be written: File too large"), std::string::npos)
      << full.err;
  EXPECT_EQ(shell("ls *.part *.trial").out, "");
  EXPECT_FALSE(fs::exists(folder_ / "x.json"));
  std::ofstream(folder_ / "y.json") << R"({"joints": {"head_yaw": {"outcome": 5}}})";
  expect_refused("bus setup --link unix:none --report y.json", "y.json: is no report");
}

TEST_F(Setup, OpensTheLinkBeforeItAsks) {
  for (const char* link : {"unix:none", "tcp:127.0.0.1:1", "serial:/dev/nothing", "pty:nobody"}) {
    const Outcome outcome = verp(std::string("bus setup --link ") + link);
    EXPECT_EQ(outcome.status, 3) << link;
    EXPECT_EQ(outcome.out, "") << link;
    EXPECT_EQ(outcome.err.find("Connect its servo"), std::string::npos) << outcome.err;
  }
}

TEST_F(Setup, ADryRunWritesNothing) {
  servos_.connect(kFromTheBox);
  auto program = setup({"--joint", "l_knee", "--dry-run"});
  do_joint(*program, 1900, 150);
  const Outcome outcome = program->wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(servos_.writes(), 0);
  for (const char* said :
       {"id 1 to 14", "baud 57600 to 2000000", "return_delay 250 to 0", "Homing Offset 0 to 148"}) {
    EXPECT_NE(outcome.err.find(said), std::string::npos) << said << "\n" << outcome.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "generic21-setup.json"));
}

TEST_F(Setup, TheWrongServosAreNamedAndTriedAgain) {
  auto program = setup({"--joint", "l_knee"});
  ASSERT_TRUE(program->says("Connect its servo alone"));
  program->type("\n");
  ASSERT_TRUE(program->says("no servo answers at any rate")) << program->wait().err;
  servos_.connect({.id = 3, .model = dxl::kModelMx28, .baud = 57600});
  program->type("\n");
  ASSERT_TRUE(program->says("it is a MX-28(2.0), the model wants a XM430-W210"))
      << program->wait().err;
  servos_.connect({.id = 4, .model = dxl::kModelXm430W210, .baud = 57600});
  program->type("\n");
  ASSERT_TRUE(program->says("2 devices answer (ids 3 and 4 among them)")) << program->wait().err;
  EXPECT_EQ(servos_.writes(), 0);
  servos_.disconnect();
  servos_.connect(kFromTheBox);
  servos_.turn_to(2048);
  program->type("\n");
  EXPECT_TRUE(program->says("found: id 1 at 57600 baud, XM430-W210"));
  program->type("quit\n");  // unknown input must not act: Enter writes EEPROM
  ASSERT_TRUE(program->says("Enter alone goes on")) << program->wait().err;
  program->type("q\n");
  EXPECT_EQ(program->wait().status, 1);
}

TEST_F(Setup, WrongWordsAndReportsAreRefused) {
  expect_refused("bus setup generic21", "--link");
  expect_refused("bus setup generic21 --joint l_kne --link pty:", "did you mean l_knee?");
  std::ofstream(folder_ / "other.json") << R"({"robot": "op3", "joints": {}})";
  expect_refused("bus setup generic21 --report other.json --link pty:", "is the report of");
  std::ofstream(folder_ / "none.json") << "none";
  expect_refused("bus setup generic21 --report none.json --link pty:", "is no report");
  // A servo written but not recorded would be set up twice.
  expect_refused("bus setup generic21 --report gone/r.json --link pty:", "cannot be written");
  expect_refused("bus setup generic21 --report . --link pty:", "is a folder");
  for (const char* entry :
       {"7", R"({"outcome": 3})", R"({"outcome": "done", "todo": []})", R"({"changes": {}})",
        R"({"changes": [1]})", R"({"changes": [{"register": 7, "before": 0, "after": 1}]})",
        R"({"changes": [{"register": "id"}]})"}) {
    std::ofstream(folder_ / "odd.json")
        << R"({"robot": "generic21", "joints": {"l_knee": )" << entry << "}}";
    expect_refused("bus setup generic21 --report odd.json --link pty:", "joint 'l_knee'");
  }
  const Outcome nothing = verp("bus setup generic21 --link serial:/dev/nothing");
  EXPECT_EQ(nothing.status, 3);
  EXPECT_EQ(nothing.out, "") << "no servo is asked for on a port that is not there";
  EXPECT_NE(nothing.err.find("no such device"), std::string::npos) << nothing.err;
  const Outcome list = verp("bus checklist generic21");
  EXPECT_EQ(list.status, 0);
  EXPECT_NE(list.out.find("verp bus setup generic21"), std::string::npos);
}

}  // namespace
}  // namespace verp::tool::test
