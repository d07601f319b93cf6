#include "host/study/compare/compare.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/host/compare/traces.hpp"

// The comparison finds delays within 1 ms and offsets within 0.1 degrees per joint under encoder
// noise; unknowable numbers are left out.

namespace verp::compare::test {
namespace {

const record::Trace& walk() {
  static const record::Trace trace = trace_of(plan_of(5));
  return trace;
}

void expect_injected(double delay_s, double offset_rad) {
  const Comparison c = compare(walk(), later(walk(), delay_s, offset_rad));
  EXPECT_EQ(c.alignment, Alignment::kOrdered);  // readings do not fit the decisions
  ASSERT_TRUE(c.delay_s);
  EXPECT_NEAR(*c.delay_s, delay_s, 1e-3);
  int with_delay = 0;
  for (const JointResult& joint : c.joints) {
    EXPECT_NEAR(joint.offset_rad, offset_rad, 0.1 * kDegree) << joint.name;
    if (!joint.delay_s) continue;
    ++with_delay;
    EXPECT_NEAR(*joint.delay_s, delay_s, 1e-3) << joint.name;
    EXPECT_LT(*joint.left_rad, 0.4 * kDegree) << joint.name;
    EXPECT_GE(joint.error_rms_rad, *joint.left_rad) << joint.name;
  }
  EXPECT_GE(with_delay, 10);  // the legs
}

TEST(Compare, ADelayAndAnOffsetAreFoundInEveryJointThatMoves) {
  expect_injected(0.010, 2 * kDegree);
  expect_injected(0.0073, -2 * kDegree);
  expect_injected(-0.010, 0.5 * kDegree);
}

TEST(Compare, ATraceAgainstItselfHasNoError) {
  const Comparison c = compare(walk(), walk());
  EXPECT_EQ(c.alignment, Alignment::kDecided);
  EXPECT_EQ(c.error_rms_rad, 0);
  ASSERT_TRUE(c.delay_s);
  EXPECT_NEAR(*c.delay_s, 0, 2e-4);
  ASSERT_TRUE(c.gait_hz);
  EXPECT_NEAR(*c.gait_hz, 1 / 0.45, 1e-6);
  for (const JointResult& joint : c.joints) {
    if (!joint.gain) continue;
    EXPECT_NEAR(*joint.gain, 1, 1e-9) << joint.name;
    EXPECT_NEAR(*joint.phase_lag_rad, 0, 1e-9) << joint.name;
  }
}

TEST(Compare, GainAndPhaseAtTheGaitsFrequencyAreThoseOfTheDelay) {
  const Comparison c = compare(walk(), later(walk(), 0.010, 0));
  int with_gain = 0;
  for (const JointResult& joint : c.joints) {
    if (!joint.gain) continue;
    ++with_gain;
    EXPECT_NEAR(*joint.gain, 1, 0.05) << joint.name;
    EXPECT_NEAR(*joint.phase_lag_rad / kDegree, 360 * 0.010 / 0.45, 2) << joint.name;
  }
  EXPECT_GE(with_gain, 6);
}

TEST(Compare, RunsThatBeganAtDifferentTimesAreLaidTogetherByWhatTheControllerBegan) {
  const Comparison c = compare(walk(), begun_later(walk(), 60), {.shift_s = -0.6});
  EXPECT_EQ(c.alignment, Alignment::kGiven);
  EXPECT_LT(c.error_rms_rad, 1e-9);
  const Comparison ordered = compare(walk(), begun_later(later(walk(), 0, 0), 60));
  EXPECT_EQ(ordered.alignment, Alignment::kOrdered);
  EXPECT_NEAR(ordered.shift_s, -0.6, 1e-9);
  ASSERT_TRUE(ordered.delay_s);
  EXPECT_NEAR(*ordered.delay_s, 0, 1e-3);
}

TEST(Compare, ATwinWhoseServosActLaterIsLateByThat) {
  session::WalkPlan plan = plan_of(5, 2);
  plan.twin.goal_delay_s = 0.010;
  const Comparison c = compare(walk(), trace_of(plan, "b.mcap"));
  EXPECT_EQ(c.alignment, Alignment::kDecided);
  ASSERT_TRUE(c.delay_s);
  EXPECT_NEAR(*c.delay_s, 0.010, 2e-3);
  EXPECT_TRUE(c.notes.empty()) << c.notes.front();
}

TEST(Compare, AJointThatHardlyMovesHasNoDelay) {
  const Comparison c = compare(walk(), later(walk(), 0.010, 0));
  int still = 0;
  for (const JointResult& joint : c.joints) {
    EXPECT_EQ(joint.delay_s.has_value(), joint.no_delay.empty()) << joint.name;
    if (joint.name.find("head") == std::string::npos) continue;
    ++still;
    EXPECT_EQ(joint.no_delay, "it hardly moves") << joint.name;
  }
  EXPECT_GE(still, 2);
}

TEST(Compare, AServoThatIsSilentHasNoDelayAndOneThatWasForATimeHas) {
  const auto index_of = [](const char* name) {
    std::size_t j = 0;
    while (std::string(walk().params.joint[j].name) != name) ++j;
    return j;
  };
  const std::size_t silent = index_of("l_knee"), lossy = index_of("r_knee");
  record::Trace b = later(walk(), 0.010, 0);
  for (std::size_t i = 0; i < b.ticks.size(); ++i) {
    b.ticks[i].inputs.fresh &= ~(1U << silent);
    if (i % 4 == 1) b.ticks[i].inputs.fresh &= ~(1U << lossy);
  }
  const Comparison c = compare(walk(), b);
  EXPECT_EQ(c.joints[silent].no_delay, "read in 0 % of the ticks only");
  ASSERT_TRUE(c.joints[lossy].delay_s) << c.joints[lossy].no_delay;
  EXPECT_NEAR(*c.joints[lossy].delay_s, 0.010, 1e-3);
}

void expect_refused(const record::Trace& a, const record::Trace& b, const char* why) {
  try {
    compare(a, b);
    FAIL() << "taken; expected: " << why;
  } catch (const record::TraceError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(';'), std::string::npos) << "no remedy";
  }
}

TEST(Compare, WhatCannotBeComparedIsRefused) {
  record::Trace other = walk();
  other.file = "b.mcap";
  std::strcpy(other.params.joint[3].name, "tail");
  expect_refused(walk(), other, "joint 3 is 'tail'");
  record::Trace empty = walk();
  empty.ticks.clear();
  expect_refused(walk(), empty, "holds no tick");
  record::Trace brief = walk();
  brief.ticks.resize(40);
  expect_refused(walk(), brief, "in common");
}

TEST(Compare, OtherOrdersAreNoted) {
  record::Trace other = walk();
  for (TickRecord& record : other.ticks) record.inputs.command.vx_tenth_mm_s = 500;
  const Comparison c = compare(walk(), other);
  ASSERT_EQ(c.notes.size(), 1u);
  EXPECT_NE(c.notes[0].find("ordered differently"), std::string::npos);
}

}  // namespace
}  // namespace verp::compare::test
