#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "host/trace/record/trace.hpp"
#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using Walk = Program;
using nlohmann::json;

bool has_leftovers(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".part") return true;
  }
  return false;
}

void cut(const fs::path& from, const fs::path& to, std::size_t size) {
  const std::string bytes = slurp(from);
  std::ofstream(to, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
}

TEST_F(Walk, JsonTraceReplayAndDiffAgree) {
  const Outcome walk = verp("walk --for 4 --json --record a.mcap");
  ASSERT_EQ(walk.status, 0) << walk.err;
  const json result = json::parse(walk.out);
  for (const char* key :
       {"model", "ticks", "duration_s", "distance_m", "speed_mean_m_s", "speed_steady_m_s",
        "ahead_m", "lateral_drift_m", "yaw_drift_deg", "fallen", "zmp_bias_mean_mm",
        "zmp_bias_by_state_mm", "servo_saturation", "digest", "real_time_factor"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  EXPECT_EQ(result.at("model"), "generic21");
  EXPECT_EQ(result.at("zmp_bias_by_state_mm").size(), 16u);
  EXPECT_FALSE(result.at("fallen"));
  EXPECT_LE(result.at("duration_s").get<double>(), 4.0 + 1e-9);

  const Outcome replay = verp("replay a.mcap --json");
  EXPECT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(json::parse(replay.out).at("digest_replayed"), result.at("digest"));
  EXPECT_EQ(verp("diff a.mcap a.mcap").status, 0);

  const Outcome info = verp("trace info a.mcap --json");
  EXPECT_EQ(json::parse(info.out).at("ticks"), result.at("ticks"));
  const Outcome csv = verp("trace export a.mcap");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.out.begin(), csv.out.end(), '\n')),
            result.at("ticks").get<std::size_t>() + 1);
}

TEST_F(Walk, WhatWasChangedStandsInSummaryReportJsonAndTrace) {
  const std::string options = "walk --for 3 --set gait.lift_m=0.02 --step 0.04 --report out";
  const Outcome walk = as_typed(options);
  EXPECT_NE(walk.out.find("changed           --set gait.lift_m=0.02\n"), std::string::npos);
  EXPECT_EQ(walk.out.find("--step"), std::string::npos) << "as by default";
  EXPECT_NE(slurp(folder_ / "out/index.html").find("gait.lift_m=0.02"), std::string::npos);
  const std::string info = verp("trace info out/run.mcap").out;
  EXPECT_NE(info.find("changed: --for 3 --set gait.lift_m=0.02"), std::string::npos) << info;
  const json changed = json::parse(as_typed("walk --for 3 --json --set gait.lift_m=0.02").out);
  EXPECT_EQ(changed.at("changed"), json::parse(R"([["--for","3"],["--set","gait.lift_m=0.02"]])"));
}

// An ordered curve is not drift.
TEST_F(Walk, ACommandedCurveIsToldAndDrawnBesideTheWayWalked) {
  const Outcome walk = verp("walk --for 6 --velocity 0.1,0,0.4 --report out");
  EXPECT_EQ(walk.status, 0) << walk.err;
  EXPECT_EQ(walk.out.find("drift"), std::string::npos) << walk.out;
  EXPECT_NE(walk.out.find(" asked\n"), std::string::npos) << walk.out;
  EXPECT_NE(slurp(folder_ / "out/index.html").find("id=\"way\""), std::string::npos);
  std::istringstream asked(slurp(folder_ / "out/asked.csv"));
  std::string line, last;
  while (std::getline(asked, line)) last = line;
  EXPECT_GT(std::stod(last.substr(last.find(',') + 1)), 0.2) << "an arc to the left: " << last;
}

TEST_F(Walk, SameSeedSameBitsOtherSeedOtherBits) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  ASSERT_EQ(verp("walk --for 3 --json --record b.mcap").status, 0);
  ASSERT_EQ(verp("walk --for 3 --json --record c.mcap --seed 2").status, 0);
  EXPECT_EQ(verp("diff a.mcap b.mcap").status, 0);
  const Outcome other = verp("diff a.mcap c.mcap --json");
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(json::parse(other.out).at("divergence").at("stage"), "inputs");
}

TEST_F(Walk, WhatPhysicsCannotFollowKeepsItsTrace) {
  const Outcome torn =
      verp("walk --for 6 --json --record a.mcap --at '1: l_foot.torque_n_m.x=100000'");
  EXPECT_EQ(torn.status, 1);
  EXPECT_NE(torn.err.find("physics diverged"), std::string::npos) << torn.err;
  EXPECT_EQ(std::count(torn.err.begin(), torn.err.end(), '\n'), 1) << torn.err;
  EXPECT_EQ(verp("replay a.mcap").status, 0);
}

TEST_F(Walk, DamagedTracesAreRefusedAndRecovered) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  cut(folder_ / "a.mcap", folder_ / "cut.mcap", fs::file_size(folder_ / "a.mcap") / 2);
  expect_refused("replay cut.mcap", "cut.mcap: byte");
  expect_refused("diff cut.mcap a.mcap", "verp trace recover");
  EXPECT_EQ(verp("trace recover cut.mcap -o whole.mcap").status, 0);
  EXPECT_EQ(verp("replay whole.mcap").status, 0);
  EXPECT_EQ(verp("diff whole.mcap a.mcap --json").status, 1) << "it is shorter";

  std::string bytes = slurp(folder_ / "a.mcap");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(folder_ / "edited.mcap", std::ios::binary) << bytes;
  expect_refused("replay edited.mcap", "edited or damaged");
}

TEST_F(Walk, ReportFolderHoldsPageNumbersAndTrace) {
  const Outcome walk = verp("walk --for 4 --report out");
  ASSERT_EQ(walk.status, 0) << walk.err;
  for (const char* file : {"index.html", "samples.csv", "zmp_bias.csv", "torque.csv", "run.mcap"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  }
  const std::string page = slurp(folder_ / "out/index.html");
  EXPECT_NE(page.find("</html>"), std::string::npos);
  for (const char* word : {"<script src", "<link", "<img", "src=\"", "@import"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << "self-contained: " << word;
  }
  EXPECT_FALSE(has_leftovers(folder_));
}

TEST_F(Walk, WithoutGnuplotNumbersRemainAndThePageSaysSo) {
  const Outcome walk = shell("PATH=/nowhere " VERP_PROGRAM " walk --for 3 --report out");
  ASSERT_EQ(walk.status, 0) << walk.err;
  EXPECT_NE(walk.err.find("gnuplot"), std::string::npos);
  EXPECT_NE(slurp(folder_ / "out/index.html").find("gnuplot is not installed"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "out/samples.csv"));
}

TEST_F(Walk, TwoCopiesDoNotClobberEachOther) {
  Outcome other;
  std::thread copy([&] { other = verp("walk --for 3 --report out", "other"); });
  const Outcome one = verp("walk --for 3 --report out", "one");
  copy.join();
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_EQ(verp("replay out/run.mcap").status, 0);
  EXPECT_FALSE(has_leftovers(folder_));
}

// As in shells: 130 for Ctrl-C, 143 for SIGTERM.
TEST_F(Walk, InterruptKeepsTraceAndReport) {
  for (const auto& [signal, status] : {std::pair("INT", "130\n"), std::pair("TERM", "143\n")}) {
    const std::string command = std::string("timeout --preserve-status -s ") + signal +
                                " 3 " VERP_PROGRAM " walk --for 600 --report out; echo status $?";
    const Outcome outcome = shell(command);
    EXPECT_TRUE(outcome.out.ends_with(std::string("status ") + status)) << outcome.out;
    EXPECT_NE(outcome.err.find("interrupted"), std::string::npos) << outcome.err;
    EXPECT_EQ(verp("replay out/run.mcap").status, 0);
    EXPECT_NE(slurp(folder_ / "out/index.html").find("Interrupted"), std::string::npos);
    EXPECT_FALSE(has_leftovers(folder_));
    fs::remove_all(folder_ / "out");
  }
}

TEST_F(Walk, ReaderThatGoesAwayIsNoCrash) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  const Outcome outcome = shell(VERP_PROGRAM " trace export a.mcap | head -n 1");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
  EXPECT_EQ(outcome.err, "");
}

// No step meets this ZMP margin.
TEST_F(Walk, PlanThatIsRefusedEndsTheRun) {
  const Outcome outcome =
      verp("walk --for 6 --no-multibody --set gait.support_margin_m=0.0299 --json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("stopped walking by itself"), std::string::npos) << outcome.err;
  EXPECT_LT(json::parse(outcome.out).at("ticks"), 2000);
}

// For any stride, turn or cycle. While strides grow, one more step means two: it must shrink again.
TEST_F(Walk, LengthIsWhatWasAskedToWithinAStep) {
  struct Asked {
    const char* options;
    double walk_s, step_s;
    int status = 0;     // 2 m/s: the limits allow less than half
    bool slow = false;  // a remark says that strides grow to the end
  };
  for (const Asked& asked :
       {Asked{"", 12, 0.225}, Asked{"--velocity 2,0,0", 8, 0.225, 1},
        Asked{"--cycle 2", 8, 1.0, 0, true}, Asked{"--velocity 0.1,0.02,0.5", 6, 0.225},
        Asked{"--cycle 0.3 --step 0", 5, 0.15},
        Asked{"--set gait.step_change_m=0.001", 16, 2 * 0.225, 0, true}}) {
    SCOPED_TRACE(asked.options);
    const Outcome walk = verp(std::string("walk --json --for ") + std::to_string(asked.walk_s) +
                              " " + asked.options);
    ASSERT_EQ(walk.status, asked.status) << walk.err;
    const json result = json::parse(walk.out);
    EXPECT_LE(result.at("duration_s").get<double>(), asked.walk_s + 1e-6);
    EXPECT_GT(result.at("duration_s").get<double>(), asked.walk_s - asked.step_s - 0.02);
    const std::string remark = result.at("remark");
    EXPECT_EQ(remark.find("whose strides grow and shrink step by step") != std::string::npos,
              asked.slow)
        << remark;
    EXPECT_TRUE(asked.slow || remark.empty()) << remark;
  }
}

// 0.6 m/s for three seconds gives 17 cm of 1.55 m.
TEST_F(Walk, AShortWalkIsHeldByWhatItsGaitGoesInThatTime) {
  const json result =
      json::parse(verp("walk --velocity 0.6,0,0 --for 3 --physics-step 2 --json").out);
  EXPECT_EQ(result.at("failure"), "");
  EXPECT_GT(result.at("distance_m").get<double>(), 0.1);
  EXPECT_NE(result.at("remark").get<std::string>().find("m of the 1.55 m asked: this gait"),
            std::string::npos)
      << result.at("remark");
  const Outcome slides =  // on ice it steps as planned and hardly advances
      verp("walk --velocity 0.6,0,0 --for 3 --no-multibody --at '0: ground.friction=0.001' --json");
  EXPECT_EQ(slides.status, 1) << slides.out;
  EXPECT_NE(slides.err.find("less than half of what its gait goes"), std::string::npos)
      << slides.err;
}

TEST_F(Walk, SeedsTellTheWayOfTheWayAsked) {
  const Outcome straight = verp("walk --seeds 1-2 --for 5 --physics-step 2");
  EXPECT_EQ(straight.status, 0) << straight.out << straight.err;
  EXPECT_TRUE(std::regex_search(
      straight.out,
      std::regex("distance, m +0\\.\\d+ to 0\\.\\d+, median 0\\.\\d+ of 0\\.\\d+ asked\n")))
      << straight.out;
  EXPECT_EQ(straight.out.find("turned"), std::string::npos);
  const Outcome curve =
      verp("walk --velocity 0.05,0,0.4 --seeds 1-2 --for 5 --physics-step 2 --json");
  for (const json& walk : json::parse(curve.out).at("walks")) {
    EXPECT_GT(walk.at("asked_turn_deg").get<double>(), 90);
    EXPECT_NEAR(walk.at("asked_m").get<double>(), 0.24, 0.02);
    EXPECT_NEAR(walk.at("ahead_m").get<double>(), 0.11, 0.06);
    EXPECT_NEAR(walk.at("lateral_drift_m").get<double>(), 0.16, 0.06) << "to the left";
  }
  EXPECT_NE(verp("walk --velocity 0.05,0,0.4 --seeds 1-2 --for 5 --physics-step 2")
                .out.find("  turned, degrees"),
            std::string::npos);
}

TEST_F(Walk, SeedsAreOfTheRobotThatHasAName) {
  const std::string rest = " --for 3 --physics-step 2 --json";
  const json alone = json::parse(verp("walk op3 --seed 1" + rest).out);
  const json many = json::parse(verp("walk --robot a=op3 --seeds 1-1" + rest).out);
  EXPECT_EQ(many.at("walks").at(0).at("digest"), alone.at("digest"));
  EXPECT_EQ(many.at("model"), "op3");
}

TEST_F(Walk, ShortestWalkThatIsLongerThanAskedSaysSo) {
  const std::string arguments = "walk --for 3 --set gait.start_s=2";
  const json result = json::parse(verp(arguments + " --json").out);
  EXPECT_GT(result.at("duration_s").get<double>(), 3.5);
  EXPECT_LT(result.at("duration_s").get<double>(), 4.5) << "start, final and two steps hardly";
  EXPECT_EQ(result.at("asked_s"), 3);
  EXPECT_NE(result.at("remark").get<std::string>().find("3 s were asked; the shortest walk"),
            std::string::npos);
  EXPECT_NE(verp(arguments).out.find("3 s were asked; the shortest walk"), std::string::npos);
}

// A zero would look like a measurement.
TEST_F(Walk, WhatWasNotMeasuredIsNullOrADash) {
  const Outcome text = verp("walk --for 3 --report out");
  EXPECT_NE(text.out.find("- steady"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("0.000 m/s"), std::string::npos) << text.out;
  EXPECT_NE(slurp(folder_ / "out/index.html").find("no cycle was steady"), std::string::npos);
  const Outcome ended =  // still rising
      shell(VERP_PROGRAM
            " walk --set safety.rise_s=10 --json --record t.mcap & "
            "until ls | grep -q t.mcap; do sleep 0.02; done; sleep 0.1; kill -INT $!; wait $!");
  const json none = json::parse(ended.out);
  EXPECT_EQ(none.at("duration_s"), 0);
  for (const char* name : {"speed_mean_m_s", "speed_steady_m_s", "zmp_bias_mean_mm",
                           "servo_saturation", "servo_saturation_worst"}) {
    EXPECT_TRUE(none.at(name).is_null()) << name;
  }
  EXPECT_TRUE(none.at("zmp_bias_by_state_mm").at(3).is_null());
}

TEST_F(Walk, AProgramThatIsKilledCountsAmongItsSeeds) {
  std::ofstream(folder_ / "kill.sh") << R"sh(
"$1" walk --seeds 1-2 --for 8 --physics-step 2 &
for try in $(seq 50); do
  for stat in /proc/[0-9]*/stat; do
    read -r pid name state parent rest <$stat || continue
    [ "$parent" = $! ] && kill -9 "$pid" && wait $! && exit
    [ "$parent" = $! ] && exit $?
  done
  sleep 0.1
done)sh";
  const Outcome outcome = shell("sh kill.sh " VERP_PROGRAM);
  EXPECT_NE(outcome.out.find(": 1 of 2 walked 8 s"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(": its program ended with status 137"), std::string::npos)
      << outcome.out;
}

TEST_F(Walk, ASpeedThatIsFarFromWhatWasAskedStandsInTheFirstLine) {
  const auto first_line = [&](const std::string& step) {
    const Outcome walk = verp("walk --for 6 --step " + step);
    EXPECT_EQ(walk.status, 0) << walk.err;
    return walk.out.substr(0, walk.out.find('\n'));
  };
  EXPECT_NE(first_line("0.005").find(" % of the speed that was asked"), std::string::npos);
  EXPECT_EQ(first_line("0.04").find("asked"), std::string::npos);
}

TEST_F(Walk, AnOrderCutToLessThanHalfIsNoGoodWalk) {
  const Outcome outcome =
      verp("walk --step 0.15 --cycle 0.3 --set gait.max_step_m=0.3 --for 15 --physics-step 2");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("less than half of what was asked"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("at 41 % of the velocity asked for"), std::string::npos);
}

TEST_F(Walk, SweepGivesATable) {
  const Outcome outcome = verp("walk --for 3 --sweep-step 0.02:0.03:0.01 --json --report out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const json result = json::parse(outcome.out);
  ASSERT_EQ(result.at("sweep").size(), 2u);
  EXPECT_DOUBLE_EQ(result.at("sweep")[1].at("step_m"), 0.03);
  EXPECT_TRUE(fs::exists(folder_ / "out/sweep.csv"));
  EXPECT_NE(slurp(folder_ / "out/index.html").find("Step length sweep"), std::string::npos);
}

TEST_F(Walk, SweepTellsAskedAndWalkedSteps) {
  const Outcome outcome =
      verp("walk --for 4 --set gait.max_step_m=0.03 --sweep-step 0.02:0.04:0.02 --report out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4.0 cm     3.0 cm"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("gait.max_step_m"), std::string::npos) << outcome.out;
  const std::string csv = slurp(folder_ / "out/sweep.csv");
  EXPECT_NE(csv.find(",0.0200,0.0200,walked,walked\n0.0400"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",0.0300,0.0300,walked,walked\n"), std::string::npos) << csv;
  EXPECT_NE(slurp(folder_ / "out/index.html").find("gait.max_step_m"), std::string::npos);
}

// It has no speed or bias; the trace is of another walk.
TEST_F(Walk, FallInASweepIsMarkedAndPointsAtNoTrace) {
  const std::string arguments =
      "walk --for 5 --set gait.max_step_m=0.3 --set gait.step_change_m=0.1 "
      "--sweep-step 0.15:0.15:0.1 --record a.mcap";
  const Outcome outcome = verp(arguments + " --json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("in the sweep, at steps of 0.15 m; walk it with --step"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("a.mcap"), std::string::npos) << outcome.err;
  const json result = json::parse(outcome.out);
  const json& row = result.at("sweep").at(0);
  EXPECT_TRUE(row.at("fallen"));
  EXPECT_EQ(row.at("end"), "fell");
  EXPECT_TRUE(row.at("speed_m_s").is_null());
  EXPECT_TRUE(row.at("zmp_bias_mm").is_null());
  EXPECT_NEAR(row.at("walked_step_m").get<double>(), 0.15, 0.001);
  EXPECT_FALSE(result.at("fallen")) << "the walk itself did not";
}

// The first walk takes seconds, the sweep a minute.
TEST_F(Walk, SweepThatIsInterruptedKeepsTheRowItWasIn) {
  const Outcome outcome = shell("timeout --preserve-status -s TERM 8 " VERP_PROGRAM
                                " walk --for 3 --sweep-step 0.01:0.05:0.001 --report out");
  EXPECT_EQ(outcome.status, 128 + SIGTERM);
  EXPECT_NE(outcome.err.find("interrupted in the sweep"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("the sweep was interrupted"), std::string::npos) << outcome.out;
  const std::string csv = slurp(folder_ / "out/sweep.csv");
  EXPECT_NE(csv.find("\n0.0100,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("interrupted"), std::string::npos) << csv;
}

}  // namespace
}  // namespace verp::tool::test
