#include "host/study/report/report.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "host/study/report/csv.hpp"
#include "host/study/report/gnuplot.hpp"

namespace verp::report {
namespace {

namespace fs = std::filesystem;

Run sample_run() {
  Run run;
  run.title = "robot <one> & \"two\"";
  run.verdict = "Walked";
  run.joints = {"l_knee", "r_knee'\n\"; quit"};
  run.bias_by_state_mm.fill(3);
  run.bias_mean_mm = 3;
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
    s.goal_rad = {0.3, 0.4};
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

/// By RFC 4180.
std::vector<std::string> header_of(const std::string& csv) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (c == '"' && quoted && csv[i + 1] == '"') {
      fields.back() += c, ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c == '\n' && !quoted) {
      break;
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

TEST(ReportNumbers, JointNamesStayInTheirColumns) {
  report::Run run = sample_run();
  run.joints = {"he,ad", "say \"knee\"\nnow"};
  const auto header = header_of(samples_csv(run));
  ASSERT_GE(header.size(), 6u);
  const std::vector<std::string> last(header.end() - 6, header.end());
  EXPECT_EQ(last, (std::vector<std::string>{"he,ad_rad", "say \"knee\"\nnow_rad", "he,ad_goal_rad",
                                            "say \"knee\"\nnow_goal_rad", "he,ad_torque_use",
                                            "say \"knee\"\nnow_torque_use"}));
  const std::string torque = torque_csv(run);
  EXPECT_NE(torque.find("\n\"he,ad\",0.25"), std::string::npos) << torque;
  EXPECT_NE(torque.find("\n\"say \"\"knee\"\"\nnow\","), std::string::npos) << torque;
}

TEST(ReportNumbers, GoalsStandBesideWhatBecameOfThem) {
  EXPECT_NE(samples_csv(sample_run()).find(",0.1,0.2,0.3,0.4,0.25,"), std::string::npos);
}

TEST(ReportNumbers, WhatWasNotMeasuredIsEmpty) {
  report::Run run = sample_run();
  run.bias_by_state_mm = {};
  run.bias_by_state_mm[1] = 2.5;
  EXPECT_EQ(bias_csv(run).substr(0, 32), "state,zmp_bias_mm\n0,\n1,2.500\n2,\n");
  using End = SweepWalk::End;
  run.sweep = {{.step_m = 0.12,
                .with = {.end = End::kWalked, .step_m = 0.07, .speed_m_s = {}, .bias_mm = 3.5},
                .without = {.end = End::kFell, .step_m = 0.05, .speed_m_s = {}, .bias_mm = {}}},
               {.step_m = 0.13,
                .with = {.end = End::kInterrupted, .step_m = {}, .speed_m_s = {}, .bias_mm = {}},
                .without = {}}};
  const std::string csv = sweep_csv(run);
  EXPECT_NE(csv.find("\n0.1200,,3.500,,0,1,0.0700,0.0500,walked,fell\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n0.1300,,,,0,0,,,interrupted,not walked\n"), std::string::npos) << csv;
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

// No steady cycle, or a robot that cannot be drawn.
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

TEST_F(ReportFolder, HoldsNothingOfTheRunBefore) {
  report::Run run = sample_run();
  run.sweep.push_back({});
  write_report(folder_, run);
  ASSERT_TRUE(fs::exists(folder_ / "sweep.csv"));
  ASSERT_TRUE(fs::exists(folder_ / "walk.png"));
  run.sweep.clear();
  run.samples.resize(20);
  std::ofstream(folder_ / "notes.txt") << "mine";
  const Written written = write_report(folder_, run);
  EXPECT_FALSE(fs::exists(folder_ / "sweep.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "walk.png"));
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
  EXPECT_NE(slurp(written.page).find("No whole cycle was walked"), std::string::npos);
}

TEST_F(ReportFolder, CallsNoCycleSteadyWhereNoneWas) {
  report::Run run = sample_run();
  run.steady = false;
  const std::string page = slurp(write_report(folder_, run).page);
  EXPECT_EQ(page.find("last steady cycle"), std::string::npos);
  EXPECT_NE(page.find("too short to become steady"), std::string::npos);
}

class BrokenGnuplot : public ReportFolder {
 protected:
  BrokenGnuplot() : path_(std::getenv("PATH")) {
    fs::create_directories(bin_);
    ::setenv("PATH", (bin_.string() + ":" + path_).c_str(), 1);
  }
  ~BrokenGnuplot() override {
    ::setenv("PATH", path_.c_str(), 1);
    fs::remove_all(bin_);
  }
  void is(const std::string& text) const {
    std::ofstream(bin_ / "gnuplot") << text;
    fs::permissions(bin_ / "gnuplot", fs::perms::owner_all);
  }
  std::string path_;
  fs::path bin_ = fs::temp_directory_path() / ("verp-gnuplot-" + std::to_string(::getpid()));
};

TEST_F(BrokenGnuplot, CostsThePlotsAndNothingElseAndSaysSoInOneLine) {
  const struct {
    const char *program, *reason;
  } kRows[] = {
      {"#!/bin/sh\necho 'no terminal svg' >&2; echo more >&2; exit 1\n",
       "failed: no terminal svg;"},
      {"#!/bin/sh\nexit 7\n", "ended with status 7"},
      {"#!/bin/sh\nkill -9 $$\n", "ended by signal 9"},
      {"#!/bin/sh\nexit 0\n", "made no picture"},
      {"neither script nor program", "cannot be started"},
  };
  for (const auto& row : kRows) {
    is(row.program);
    const Written written = write_report(folder_, sample_run());
    EXPECT_EQ(written.note.find((folder_ / "index.html").string() + ": 8 of 8 plots"), 0u)
        << written.note;
    EXPECT_NE(written.note.find(row.reason), std::string::npos) << written.note;
    EXPECT_NE(written.note.find("apt-get install --reinstall gnuplot-nox"), std::string::npos);
    EXPECT_EQ(written.note.find('\n'), std::string::npos) << written.note;
    EXPECT_NE(slurp(written.page).find("plots are missing"), std::string::npos);
    for (const char* file : {"samples.csv", "zmp_bias.csv", "torque.csv"}) {
      EXPECT_GT(fs::file_size(folder_ / file), 50u) << file;
    }
    EXPECT_FALSE(fs::exists(folder_ / "walk.png"));
    fs::remove_all(folder_);
  }
}

TEST_F(ReportFolder, TmpdirThatIsOfNoUseCostsNothing) {
  if (!gnuplot_available()) GTEST_FAIL() << "gnuplot-nox is missing (toolchains/packages.txt)";
  for (const char* place : {"/nowhere", "/proc", "/dev/null"}) {
    ::setenv("TMPDIR", place, 1);
    const Written written = write_report(folder_, sample_run());
    ::unsetenv("TMPDIR");
    EXPECT_EQ(written.note, "") << place;
    EXPECT_TRUE(fs::exists(folder_ / "walk.png")) << place;
  }
}

TEST_F(ReportFolder, WithoutAnyBiasThereIsNoPlotOfOne) {
  report::Run run = sample_run();
  report::SweepRow row;
  row.with.end = SweepWalk::End::kFell;
  run.sweep = {row};
  run.bias_by_state_mm = {};
  run.bias_mean_mm = {};
  const Written written = write_report(folder_, run);
  EXPECT_EQ(written.note, "");
  const std::string page = slurp(written.page);
  EXPECT_EQ(page.find("id=\"sweep\""), std::string::npos);
  EXPECT_EQ(page.find("id=\"bias\""), std::string::npos);
  EXPECT_NE(page.find(">fell<"), std::string::npos);
  EXPECT_NE(page.find(">not walked<"), std::string::npos);
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
