#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/host/tool/program.hpp"

namespace verp::tool::test {
namespace {

using Bench = Program;

TEST_F(Bench, JsonIsOneObjectWithEveryCostOfThePcAndKdlAgreesWithUs) {
  const Outcome outcome = verp("bench --pc --repetitions 1 --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(json.at("kept"));
  std::map<std::string, double> bars;  // 0: no promise
  for (const auto& row : json.at("results")) {
    bars[row.at("name")] = row.value("at_least", row.value("at_most", 0.0));
    EXPECT_EQ(row.count("failed"), 0) << row;
    EXPECT_GT(row.at("value"), 0) << "all is installed for the tests: " << row;
    EXPECT_EQ(row.at("where") == "languages",
              row.at("name").get<std::string>().ends_with("_ticks_per_s"))
        << row;
    EXPECT_EQ(row.value("judged", false), row.at("name") == "state_bytes")
        << "times are not: " << row;
  }
  const std::map<std::string, double> wanted = {{"tick_us", 3},
                                                {"digest_us", 0},
                                                {"leg_ik_us", 0},
                                                {"kdl_leg_ik_us", 0},
                                                {"leg_ik_times_faster", 100},
                                                {"body_kinematics_us", 0},
                                                {"state_bytes", 3072},
                                                {"cpp_ticks_per_s", 0},
                                                {"csharp_ticks_per_s", 0},
                                                {"python_ticks_per_s", 5000},
                                                {"octave_ticks_per_s", 2000},
                                                {"external_ticks_per_s", 2000}};
  EXPECT_EQ(bars, wanted);
  const std::string solver = json.at("kdl_check").at("solver");
  EXPECT_EQ(solver, "NR with WDLS") << "the better of KDL's, by five or six times";
  EXPECT_GE(json.at("kdl_check").at("targets"), 500);
  EXPECT_LT(json.at("kdl_check").at("apart_rad"), 5e-3);
  EXPECT_LT(json.at("kdl_check").at("apart_m"), 1e-4);
}

TEST_F(Bench, TableHasTheBarBesideEachPromisedNumber) {
  const Outcome outcome = verp("bench --pc --repetitions 1");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* bar :
       {"at most 3 µs", "at least 100 times", "at most 3072 bytes", "at least 2000 ticks/s"}) {
    EXPECT_NE(outcome.out.find(bar), std::string::npos) << bar << '\n' << outcome.out;
  }
}

// The others are measured, and the row names what to install.
TEST_F(Bench, LanguageThatIsNotInstalledSaysSoAndFailsNobody) {
  const Outcome outcome = shell("mkdir few && ln -s /bin/sh few/sh && PATH=$PWD/few " VERP_PROGRAM
                                " bench --only languages --repetitions 1");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("CPU time here"), std::string::npos) << "only languages:\n"
                                                                  << outcome.out;
  for (const char* words : {"not measured; install it: apt-get install octave octave-dev",
                            "not measured; install it: apt-get install mono-mcs mono-runtime",
                            "at least 5000 ticks/s"}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << '\n' << outcome.out;
  }
}

TEST_F(Bench, AnswerThatKdlDoesNotGiveIsFound) {
  const std::string peers = VERP_BENCH_PEERS " . --benchmark_min_time=0.01";
  ASSERT_EQ(shell(VERP_BENCH_CORE " . --benchmark_filter=none").status, 0);
  EXPECT_EQ(shell(peers).status, 0);
  // Line 9: our answer to the first target.
  const Outcome wrong = shell("sed -i '9s/^[^ ]*/0.5/' leg && " + peers);
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("disagree"), std::string::npos) << wrong.err;
  EXPECT_EQ(shell("sed -i '20,$d' leg && " + peers).status, 2) << "a truncated file";
}

TEST_F(Bench, BadUsageIsRefused) {
  expect_refused("bench --repetitions 0", "--repetitions");
  expect_refused("bench --repetitions many", "--repetitions");
  expect_refused("bench --jsn", "did you mean --json?");
  expect_refused("bench generic21", "generic21");
  expect_refused("bench --only language", "--only");
}

TEST_F(Bench, BoardWithoutImageIsToldBeforeTheTimings) {
  const Outcome outcome = shell("VERP_FIRMWARE_DIR=. " VERP_PROGRAM " bench --json");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("build it"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace verp::tool::test
