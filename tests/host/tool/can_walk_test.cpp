#include <nlohmann/json.hpp>

#include "host/robot/model/find.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

class CanWalk : public Program {
 protected:
  nlohmann::json walk(const std::string& arguments, const std::string& name,
                      const std::string& robot = "generic21") const {
    const Outcome outcome = verp("walk " + robot + " --bus can --json " + arguments, name);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
  }
  std::string robot_at(int period_us) const {
    std::string text = slurp(model::find_model("generic21"));
    const std::string bus = "protocol=\"cia402\" baud=\"1000000\" period_us=\"";
    const std::size_t at = text.find(bus + "10000");
    EXPECT_NE(at, std::string::npos);
    text.replace(at + bus.size(), 5, std::to_string(period_us));
    const std::string name = "at" + std::to_string(period_us) + ".sdf";
    std::ofstream(folder_ / name) << text;
    return name;
  }
  nlohmann::json load_row(int rate_hz) const {
    const nlohmann::json json =
        nlohmann::json::parse(verp("bus load --robot generic21 --json", "load").out);
    for (const nlohmann::json& row : json["rows"]) {
      if (row["rate_hz"] == rate_hz && row["buses"] == 1 && row["fd"] == false) return row;
    }
    return {};
  }
};

TEST_F(CanWalk, WalksTenSecondsWithoutAFallOrAFault) {
  const nlohmann::json json = walk("--for 10", "ten");
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["bus"], "can");
  EXPECT_EQ(json["fallen"], false);
  EXPECT_GE(json["duration_s"].get<double>(), 9);
  EXPECT_GT(json["distance_m"].get<double>(), 1);
}

// At each rate that fits one classic bus. The table knows no walk, so the test compares bits
// without stuffing, and expected bits with all bits walked.
TEST_F(CanWalk, PutsOnTheWireWhatBusLoadSays) {
  for (const int period_us : {10'000, 8'000}) {
    SCOPED_TRACE(period_us);
    const nlohmann::json json = walk("--for 5", "walk", robot_at(period_us));
    const nlohmann::json row = load_row(1'000'000 / period_us);
    ASSERT_TRUE(row.is_object());
    const double bare = row["bits_without_stuffing"].get<double>();
    const double expected = row["bits_expected"].get<double>();
    const double walked_bare = json["can_bits_per_tick_without_stuffing"].get<double>();
    const double walked = json["can_bits_per_tick"].get<double>();
    EXPECT_NEAR(walked_bare, bare, 0.05 * bare);
    EXPECT_NEAR(walked, expected, 0.05 * expected);
    EXPECT_GT(walked, walked_bare);
    EXPECT_LT(walked, row["bits_with_worst_stuffing"].get<double>());
    EXPECT_EQ(json["can_overruns"], 0);
  }
}

// Before anything moves or an interface is opened.
TEST_F(CanWalk, ARobotWhoseBusHasNoRoomIsRefusedByName) {
  const std::string robot = robot_at(6000) + " --bus can";
  const std::string needle = ": r_knee (node 13) and those after it do not fit";
  for (const char* const command : {"check ", "walk ", "export -o image "}) {
    expect_refused(command + robot, needle);
  }
  expect_refused("hil --link can:vcan0 " + robot, needle);
  expect_refused("run --link can:vcan0 " + robot, needle);
  expect_refused("run generic21 --bus can --link can:vcan0 --period 5",
                 "l_ankle_roll (node 18) and those after it do not fit");
  EXPECT_NE(verp("run --link can:nowhere --period 8 " + robot).status, 2) << "another period fits";
}

TEST_F(CanWalk, GivesTheSameDigestEachTime) {
  const nlohmann::json first = walk("--for 3", "first");
  const nlohmann::json second = walk("--for 3", "second");
  ASSERT_TRUE(first.is_object());
  EXPECT_EQ(first["digest"], second["digest"]);
  EXPECT_EQ(first["ticks"], second["ticks"]);
}

// From the counts alone.
TEST_F(CanWalk, ItsTraceReplays) {
  walk("--for 3 --record can.mcap", "recorded");
  const Outcome replayed = verp("replay can.mcap", "replayed");
  EXPECT_EQ(replayed.status, 0) << replayed.err << replayed.out;
}

TEST_F(CanWalk, BusesAreChosenByName) {
  expect_refused("walk generic21 --bus usb", "dxl, can");
  expect_refused("hil generic21 --bus can --link tcp:localhost:1", "is no CAN interface");
  expect_refused("run generic21 --bus can --link serial:/dev/null@1000000", "is no CAN interface");
  const Outcome checked = verp("check generic21 --bus can --json", "checked");
  EXPECT_EQ(checked.status, 0) << checked.err;
  const nlohmann::json bus = nlohmann::json::parse(checked.out)["bus"];
  EXPECT_EQ(bus["protocol"], "cia402");
  EXPECT_LT(bus["share"].get<double>(), 0.8);
}

TEST_F(CanWalk, BusLoadIsATableThatNamesWhatIsRefused) {
  const Outcome outcome = verp("bus load --robot generic21 --json", "load");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["rows"].size(), 16u);
  for (const nlohmann::json& row : json["rows"]) {
    EXPECT_EQ(row["admitted"].get<bool>(), row["refusal"].get<std::string>().empty());
    if (row["rate_hz"] != 125 || row["buses"] != 1 || row["fd"] == true) continue;
    EXPECT_LE(row["share_with_worst_stuffing"].get<double>(), 0.7);
    EXPECT_EQ(row["admitted"], true);
  }
  expect_refused("bus load --robot generic21 --bus dxl", "has no CAN bus named 'dxl'");
}

TEST_F(CanWalk, BusLoadOfARobotThatDoesNotFitIsATableToo) {
  const std::string command = "bus load --robot " + robot_at(5000);
  const Outcome text = verp(command, "text");
  EXPECT_EQ(text.status, 2);
  EXPECT_NE(text.out.find("no stuffing"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("are arithmetic"), std::string::npos) << text.out;
  EXPECT_NE(text.err.find("at5000.sdf:"), std::string::npos) << text.err;
  EXPECT_EQ(std::count(text.err.begin(), text.err.end(), '\n'), 1) << text.err;
  const Outcome outcome = verp(command + " --json", "json");
  EXPECT_EQ(outcome.status, 2);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["admitted"], false);
  EXPECT_NE(json["refusal"].get<std::string>().find("node 18"), std::string::npos);
  EXPECT_EQ(json["rows"].size(), 16u);
}

}  // namespace
}  // namespace verp::tool::test
