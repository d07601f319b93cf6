#include <nlohmann/json.hpp>
#include <thread>

#include "host/record/trace.hpp"
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

// One object on stdout with everything design promises; the trace replays to the same digest.
TEST_F(Walk, JsonTraceReplayAndDiffAgree) {
  const Outcome walk = verp("walk --for 4 --json --record a.mcap");
  ASSERT_EQ(walk.status, 0) << walk.err;
  const json result = json::parse(walk.out);
  for (const char* key :
       {"model", "ticks", "duration_s", "distance_m", "speed_mean_m_s", "speed_steady_m_s",
        "lateral_drift_m", "yaw_drift_deg", "fallen", "zmp_bias_mean_mm", "zmp_bias_by_state_mm",
        "servo_saturation", "digest", "real_time_factor"}) {
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

TEST_F(Walk, SameSeedSameBitsOtherSeedOtherBits) {
  ASSERT_EQ(verp("walk --for 3 --json --record a.mcap").status, 0);
  ASSERT_EQ(verp("walk --for 3 --json --record b.mcap").status, 0);
  ASSERT_EQ(verp("walk --for 3 --json --record c.mcap --seed 2").status, 0);
  EXPECT_EQ(verp("diff a.mcap b.mcap").status, 0);
  const Outcome other = verp("diff a.mcap c.mcap --json");
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(json::parse(other.out).at("divergence").at("stage"), "inputs");
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
  EXPECT_EQ(page.find("src="), std::string::npos) << "self-contained";
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

// Ctrl-C: exit 1, and what was walked so far is a whole trace and a report.
TEST_F(Walk, InterruptKeepsTraceAndReport) {
  for (const char* signal : {"INT", "TERM"}) {
    const std::string command = std::string("timeout -s ") + signal +
                                " 3 " VERP_PROGRAM " walk --for 600 --report out; echo status $?";
    const Outcome outcome = shell(command);
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

// No step keeps the ZMP where this margin wants it: the robot stands, and the run ends and says so.
TEST_F(Walk, PlanThatIsRefusedEndsTheRun) {
  const Outcome outcome =
      verp("walk --for 6 --no-multibody --set gait.support_margin_m=0.0299 --json");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("stopped walking by itself"), std::string::npos) << outcome.err;
  EXPECT_LT(json::parse(outcome.out).at("ticks"), 2000);
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

}  // namespace
}  // namespace verp::tool::test
