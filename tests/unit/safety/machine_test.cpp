#include "common/safety/machine.hpp"

#include <gtest/gtest.h>

/// Each test is named after its row's promise and states the row.
namespace verp::safety {
namespace {

constexpr std::uint32_t kAllConditions = 1u << 20;

constexpr std::uint32_t bit(Mode mode) {
  return 1u << static_cast<unsigned>(mode);
}
constexpr Mode mode_of(int index) {
  return static_cast<Mode>(index);
}
template <class... Modes>
constexpr std::uint32_t modes(Modes... each) {
  return (bit(each) | ...);
}

// Exactly these conditions lead from row `index` to `to`; with one missing or one excluded it does
// not match.
void expect_row(int index, std::uint32_t from, std::uint32_t all_of, std::uint32_t none_of,
                Mode to) {
  ASSERT_LT(index, kRows);
  const Row& row = kTable[index];
  EXPECT_EQ(row.from, from);
  EXPECT_EQ(row.all_of, all_of);
  EXPECT_EQ(row.none_of, none_of);
  EXPECT_TRUE(row.to == to);
  for (int m = 0; m < kModes; ++m) {
    const Mode mode = mode_of(m);
    if ((from & bit(mode)) == 0 || mode == to) continue;
    EXPECT_TRUE(next_mode(mode, all_of) == to) << "from " << kModeNames[m];
    for (std::uint32_t c = 1; c < kAllConditions; c <<= 1) {
      if ((all_of & c) != 0) {
        EXPECT_FALSE(next_mode(mode, all_of & ~c) == to)
            << "from " << kModeNames[m] << " without condition " << c;
      }
      if ((none_of & c) != 0) {
        EXPECT_FALSE(next_mode(mode, all_of | c) == to)
            << "from " << kModeNames[m] << " in spite of condition " << c;
      }
    }
  }
}

constexpr std::uint32_t kUpright = modes(Mode::kRising, Mode::kStanding, Mode::kWalking,
                                         Mode::kHolding, Mode::kSitting, Mode::kActing);

TEST(SafetyTable, Row0EmergencyStopsEveryMode) {
  expect_row(0, 0xFFFu & ~bit(Mode::kStopped), kEmergency, 0, Mode::kStopped);
}
TEST(SafetyTable, Row1StoppedRobotIsRelaxedOnceReleasedAndAsked) {
  expect_row(1, bit(Mode::kStopped), kAskRelax, kEmergency, Mode::kRelaxed);
}
TEST(SafetyTable, Row2FallMakesUprightRobotLimp) {
  expect_row(2, kUpright, kFell, 0, Mode::kFallen);
}
TEST(SafetyTable, Row3FallenRobotIsRelaxedWhenAsked) {
  expect_row(3, bit(Mode::kFallen), kAskRelax, 0, Mode::kRelaxed);
}
TEST(SafetyTable, Row4SilenceHoldsMovingRobot) {
  expect_row(4,
             modes(Mode::kRising, Mode::kStanding, Mode::kWalking, Mode::kActing, Mode::kGettingUp),
             kStale, 0, Mode::kHolding);
}
TEST(SafetyTable, Row5LastingSilenceSitsDown) {
  expect_row(5, bit(Mode::kHolding), kLost, 0, Mode::kSitting);
}
TEST(SafetyTable, Row6AskedToRelaxItSitsDownFirst) {
  expect_row(6, modes(Mode::kRising, Mode::kStanding, Mode::kHolding), kAskRelax, 0,
             Mode::kSitting);
}
TEST(SafetyTable, Row7PowerTroubleSitsDown) {
  expect_row(7, modes(Mode::kRising, Mode::kStanding, Mode::kHolding), kTrouble, kStale,
             Mode::kSitting);
}
TEST(SafetyTable, Row8EndOfSilenceRisesAgain) {
  expect_row(8, bit(Mode::kHolding), 0, kStale, Mode::kRising);
}
TEST(SafetyTable, Row9AbandonedRobotSitsDown) {
  expect_row(9, bit(Mode::kStanding), kOperatorGone, 0, Mode::kSitting);
}
TEST(SafetyTable, Row10RelaxedRobotRisesOnlyWhenAllIsWell) {
  expect_row(10, bit(Mode::kRelaxed), kAskStand | kServosKnown,
             kFell | kStale | kOperatorQuiet | kTrouble | kJointBeyond, Mode::kRising);
}
TEST(SafetyTable, Row11RiseEndsInTheStand) {
  expect_row(11, bit(Mode::kRising), kTimeUp, 0, Mode::kStanding);
}
TEST(SafetyTable, Row12WalksOnlyCalibratedAndWatched) {
  expect_row(12, bit(Mode::kStanding), kAskWalk | kCalibrated, kOperatorQuiet, Mode::kWalking);
}
TEST(SafetyTable, Row13StepsUnaskedOnlyWhenPushedCalibratedAndWatched) {
  expect_row(13, bit(Mode::kStanding), kPushed | kCalibrated, kOperatorQuiet, Mode::kWalking);
}
TEST(SafetyTable, Row14WalkEndsOnBothFeetWhenNoLongerAskedNorPushed) {
  expect_row(14, bit(Mode::kWalking), kGaitOver, kAskWalk | kPushed, Mode::kStanding);
}
TEST(SafetyTable, Row15WalkEndsOnBothFeetWhenTheOperatorIsQuiet) {
  ASSERT_LT(15, kRows);
  EXPECT_TRUE(next_mode(Mode::kWalking, kGaitOver | kAskWalk | kOperatorQuiet) == Mode::kStanding);
  EXPECT_TRUE(next_mode(Mode::kWalking, kAskWalk | kOperatorQuiet) == Mode::kWalking);
  EXPECT_EQ(kTable[15].all_of, kGaitOver | kOperatorQuiet);
}
TEST(SafetyTable, Row16WalkEndsOnBothFeetWhenPowerIsBad) {
  ASSERT_LT(16, kRows);
  EXPECT_TRUE(next_mode(Mode::kWalking, kGaitOver | kAskWalk | kTrouble) == Mode::kStanding);
  EXPECT_TRUE(next_mode(Mode::kWalking, kAskWalk | kTrouble) == Mode::kWalking);
  EXPECT_EQ(kTable[16].all_of, kGaitOver | kTrouble);
}
TEST(SafetyTable, Row17RobotThatCannotLieDownRelaxesInTheCrouch) {
  expect_row(17, bit(Mode::kSitting), kTimeUp, kLiesDown, Mode::kRelaxed);
}
TEST(SafetyTable, Row18ActsOnlyWhenAllIsWell) {
  expect_row(18, bit(Mode::kStanding), kAskAction | kCalibrated, kOperatorQuiet | kTrouble,
             Mode::kActing);
}
TEST(SafetyTable, Row19ActionEndsInTheStand) {
  expect_row(19, bit(Mode::kActing), kTimeUp, 0, Mode::kStanding);
}
TEST(SafetyTable, Row20FallIsMetBeforeTheGroundIs) {
  expect_row(20,
             modes(Mode::kRising, Mode::kStanding, Mode::kWalking, Mode::kActing, Mode::kSitting),
             kFallSeen, kStale, Mode::kFalling);
}
TEST(SafetyTable, Row21FallEndsLimpOnTheFloor) {
  expect_row(21, bit(Mode::kFalling), kTimeUp | kFell, 0, Mode::kFallen);
}
TEST(SafetyTable, Row22FallThatWasNoneHolds) {
  expect_row(22, bit(Mode::kFalling), kTimeUp, 0, Mode::kHolding);
}
TEST(SafetyTable, Row23GetsUpOnlyWhenAskedAndAllIsWell) {
  expect_row(23, modes(Mode::kFallen, Mode::kRelaxed), kAskGetUp | kServosKnown,
             kStale | kOperatorQuiet | kTrouble | kJointBeyond, Mode::kGettingUp);
}
TEST(SafetyTable, Row24GettingUpThatEndsLyingIsAFall) {
  expect_row(24, bit(Mode::kGettingUp), kTimeUp | kFell, 0, Mode::kFallen);
}
TEST(SafetyTable, Row25GettingUpEndsInTheStand) {
  expect_row(25, bit(Mode::kGettingUp), kTimeUp, 0, Mode::kStanding);
}
TEST(SafetyTable, Row26LiesDownFromTheCrouch) {
  expect_row(26, bit(Mode::kSitting), kTimeUp | kLiesDown, 0, Mode::kLyingDown);
}
TEST(SafetyTable, Row27RobotThatLiesRelaxes) {
  expect_row(27, bit(Mode::kLyingDown), kTimeUp, 0, Mode::kRelaxed);
}
TEST(SafetyTable, HasNoOtherRows) {
  EXPECT_EQ(kRows, 28);
}
TEST(SafetyTable, OnlySittingLooksAtLyingDown) {
  for (int i = 0; i < kRows; ++i) {
    const bool looks = ((kTable[i].all_of | kTable[i].none_of) & kLiesDown) != 0;
    EXPECT_TRUE(!looks || kTable[i].from == bit(Mode::kSitting)) << i;
  }
}

// A condition that only sitting looks at (OnlySittingLooksAtLyingDown) is set for it alone.
bool same_as_without(Mode from, std::uint32_t conditions) {
  return (conditions & kLiesDown) != 0 && from != Mode::kSitting;
}

template <class Check>
void for_all(Check check) {
  for (std::uint32_t conditions = 0; conditions < kAllConditions; ++conditions) {
    for (int m = 0; m < kModes; ++m) {
      if (same_as_without(mode_of(m), conditions)) continue;
      check(mode_of(m), conditions, next_mode(mode_of(m), conditions));
    }
  }
}

TEST(SafetyMachine, EmergencyAlwaysWins) {
  int wrong = 0;
  for_all([&](Mode, std::uint32_t conditions, Mode to) {
    if ((conditions & kEmergency) != 0 && to != Mode::kStopped) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

// Except on the way down and the requested way up.
TEST(SafetyMachine, FallenRobotNeverKeepsTorque) {
  constexpr std::uint32_t kOnTheFloor = modes(Mode::kFalling, Mode::kGettingUp, Mode::kLyingDown);
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if ((conditions & kFell) == 0 || !has_torque(to) || (bit(to) & kOnTheFloor) != 0) return;
    const bool silent = from == Mode::kGettingUp && to == Mode::kHolding;  // limp next tick
    if (!silent) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, TorqueComesOnlyByRisingAndByGettingUpAndWhenAsked) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if (has_torque(from) || !has_torque(to)) return;
    const bool risen =
        from == Mode::kRelaxed && to == Mode::kRising && (conditions & kAskStand) != 0;
    const bool got_up =
        from != Mode::kStopped && to == Mode::kGettingUp && (conditions & kAskGetUp) != 0;
    if (!risen && !got_up) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, StandingRobotIsNeverDropped) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if (!has_torque(from) || has_torque(to)) return;
    const bool down = from == Mode::kSitting || from == Mode::kLyingDown;
    const bool why = (conditions & (kEmergency | kFell)) != 0 || down;
    if (!why) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, RobotLiesDownOnlyFromTheCrouchAndThenLetsGo) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if (to == Mode::kLyingDown && from != to && from != Mode::kSitting) ++wrong;
    if (from != Mode::kLyingDown || from == to) return;
    const bool over = to == Mode::kRelaxed && (conditions & kTimeUp) != 0;
    if (!over && to != Mode::kStopped) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, WalkingStopsOnlyOnBothFeetUnlessItMust) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if (from != Mode::kWalking || to != Mode::kStanding) return;
    if ((conditions & kGaitOver) == 0) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, PowerTroubleNeverBeginsARiseAWalkAnActionOrGettingUp) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if ((conditions & kTrouble) == 0 || from == to) return;
    if (to == Mode::kRising || to == Mode::kWalking || to == Mode::kActing ||
        to == Mode::kGettingUp) {
      ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, NobodyWalksUnlessAskedOrPushed) {
  int wrong = 0;
  for_all([&](Mode from, std::uint32_t conditions, Mode to) {
    if (from == Mode::kWalking || to != Mode::kWalking) return;
    if ((conditions & (kAskWalk | kPushed)) == 0) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
}

TEST(SafetyMachine, TorqueIsOnInTheModesThatNeedIt) {
  const std::uint32_t limp = modes(Mode::kRelaxed, Mode::kFallen, Mode::kStopped);
  for (int m = 0; m < kModes; ++m) {
    EXPECT_EQ(has_torque(mode_of(m)), (limp & (1u << m)) == 0) << kModeNames[m];
  }
}

// All modes one transition away, under any conditions.
std::uint32_t reach(std::uint32_t from) {
  std::uint32_t result = from;
  for_all([&](Mode mode, std::uint32_t, Mode to) {
    if ((from & bit(mode)) != 0) result |= bit(to);
  });
  return result;
}

TEST(SafetyMachine, EveryModeIsReachedFromPowerUp) {
  std::uint32_t reached = bit(Mode::kRelaxed);
  for (int i = 0; i < 4; ++i) reached = reach(reached);
  EXPECT_EQ(reached, 0xFFFu);
}

TEST(SafetyMachine, NoModeIsWithoutAWayOutBackToRelaxed) {
  for (int m = 0; m < kModes; ++m) {
    std::uint32_t reached = 1u << m;
    for (int i = 0; i < 3; ++i) reached = reach(reached);
    EXPECT_NE(reached & bit(Mode::kRelaxed), 0u) << kModeNames[m];
  }
}

TEST(SafetyMachine, NoConditionsNoChange) {
  for (int m = 0; m < kModes; ++m) {
    if (mode_of(m) == Mode::kHolding) continue;
    EXPECT_TRUE(next_mode(mode_of(m), 0) == mode_of(m)) << kModeNames[m];
  }
}

}  // namespace
}  // namespace verp::safety
