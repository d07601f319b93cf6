#include "host/report/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "host/report/csv.hpp"
#include "host/report/gnuplot.hpp"

namespace verp::report {
namespace {

namespace fs = std::filesystem;

/// Ten seconds at 0.2 m/s along x with a cycle of 16 states.
Run sample_run() {
  Run run;
  run.title = "robot <one> & \"two\"";
  run.verdict = "Walked";
  run.joints = {"l_knee", "r_knee'\n\"; quit"};
  run.leg_joints = {std::vector<int>{0}, std::vector<int>{1}};
  run.limbs = {{Limb::Kind::kTrunk, 2}, {Limb::Kind::kHead, 2}, {Limb::Kind::kLeg, 1}};
  for (int i = 0; i < 1000; ++i) {
    Sample s;
    s.t_s = 0.01 * i;
    s.phase = i < 50 ? 1 : i > 950 ? 3 : 2;
    s.state = (i % 45) / 3;
    s.carrying = s.state < 8 ? 0 : 1;
    s.contact = {true, true};
    s.body = {0.2 * s.t_s, 0.01 * std::sin(14 * s.t_s), 0.27};
    s.zmp = Point2{s.body.x_m, 0.03};
    if (i >= 20) s.zmp_planned = Point2{s.body.x_m, 0.04};
    s.zmp_bias_mm = 3;
    const double x_m = s.body.x_m;
    s.limb = {{{x_m, 0, 0.2}, {x_m, 0, 0.35}},
              {{x_m, 0, 0.35}, {x_m, 0, 0.4}},
              {{x_m, 0, 0.2}, {x_m + 0.03, 0, 0.1}, {x_m, 0, 0}}};
    s.joint_rad = {0.1, 0.2};
    s.torque_use = {0.25, i == 10 ? 0.9 : 0.1};
    run.samples.push_back(s);
  }
  return run;
}

std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ReportNumbers, SpeedIsThatOfTheBody) {
  const auto speed = speed_m_s(sample_run());
  EXPECT_NEAR(speed[500], 0.2, 1e-9);
}

TEST(ReportNumbers, TorqueHasMeanAndPeak) {
  const auto use = torque_use(sample_run());
  EXPECT_NEAR(use[0].mean, 0.25, 1e-9);
  EXPECT_DOUBLE_EQ(use[1].peak, 0.9);
}

TEST(ReportNumbers, SteadyCycleIsWholeAndOfTheTransition) {
  const report::Run run = sample_run();
  const Range cycle = last_steady_cycle(run);
  ASSERT_EQ(cycle.last - cycle.first, 45u);
  EXPECT_EQ(run.samples[cycle.first].state, 0);
  EXPECT_EQ(run.samples[cycle.last].phase, 2);
}

TEST(ReportNumbers, PlannedZmpStandsBesideTheMeasuredOneAndIsEmptyWhereThereIsNone) {
  const std::string csv = samples_csv(sample_run());
  EXPECT_NE(csv.find("zmp_x_m,zmp_y_m,zmp_planned_x_m,zmp_planned_y_m,zmp_bias_mm"),
            std::string::npos);
  EXPECT_NE(csv.find(",0,0.03,,,3,"), std::string::npos) << "first tick";
  EXPECT_NE(csv.find(",0.04,0.03,0.04,0.04,3,"), std::string::npos) << "at 0.2 s";
}

TEST(ReportNumbers, RunWithoutSamplesIsNoCrash) {
  EXPECT_TRUE(last_steady_cycle(report::Run{}).empty());
  EXPECT_TRUE(speed_m_s(report::Run{}).empty());
}

class ReportFolder : public ::testing::Test {
 protected:
  ReportFolder()
      : folder_(fs::temp_directory_path() / ("verp-report-" + std::to_string(::getpid()))) {}
  ~ReportFolder() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(ReportFolder, PageEscapesNamesAndFollowsTheTheme) {
  if (!gnuplot_available()) GTEST_FAIL() << "gnuplot-nox is missing (toolchains/packages.txt)";
  const Written written = write_report(folder_, sample_run());
  EXPECT_EQ(written.note, "");
  const std::string page = slurp(written.page);
  EXPECT_NE(page.find("robot &lt;one&gt; &amp; &quot;two&quot;"), std::string::npos);
  for (const char* id : {"figure", "joints", "keypoints", "zmp", "bias", "speed", "torque"}) {
    EXPECT_NE(page.find(std::string("id=\"") + id + "\""), std::string::npos) << id;
  }
  EXPECT_EQ(page.find("rgb("), std::string::npos) << "a colour that a dark page would not change";
  EXPECT_NE(page.find("var(--ink)"), std::string::npos);
}

TEST_F(ReportFolder, HasAPictureToShowToOthers) {
  if (!gnuplot_available()) GTEST_FAIL() << "gnuplot-nox is missing (toolchains/packages.txt)";
  write_report(folder_, sample_run());
  EXPECT_EQ(slurp(folder_ / "walk.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
}

// Without a steady cycle, or of a robot that cannot be drawn, the rest of the report stands.
TEST_F(ReportFolder, LeavesOutWhatARunHasNoDataFor) {
  report::Run run = sample_run();
  run.limbs.clear();
  for (Sample& s : run.samples) {
    s.limb.clear();
    s.zmp_planned.reset();
  }
  const Written written = write_report(folder_, run);
  EXPECT_EQ(written.note, "");
  const std::string page = slurp(written.page);
  EXPECT_EQ(page.find("id=\"figure\""), std::string::npos);
  EXPECT_EQ(page.find("planned ZMP"), std::string::npos);
  EXPECT_NE(page.find("id=\"zmp\""), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "walk.png"));
}

TEST_F(ReportFolder, OtherFilesInTheFolderStay) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "mine.txt") << "keep";
  write_report(folder_, sample_run());
  EXPECT_EQ(slurp(folder_ / "mine.txt"), "keep");
}

TEST_F(ReportFolder, FileInTheWayIsAClearError) {
  std::ofstream(folder_) << "x";
  EXPECT_THROW(write_report(folder_, sample_run()), ReportError);
}

}  // namespace
}  // namespace verp::report
