#include "common/protocol/canopen/cia402.hpp"

#include <gtest/gtest.h>

namespace verp::canopen::cia402 {
namespace {

constexpr State kAll[] = {State::kNotReady,
                          State::kSwitchOnDisabled,
                          State::kReadyToSwitchOn,
                          State::kSwitchedOn,
                          State::kOperationEnabled,
                          State::kQuickStopActive,
                          State::kFaultReactionActive,
                          State::kFault};
constexpr std::int16_t kLeaves = 2;  // quick stop option codes: ends in switch on disabled
constexpr std::int16_t kStays = 6;   // stays in quick stop active

// Last controlword 0.
Drive in(State state) {
  Drive drive;
  if (state == State::kNotReady) return drive;
  drive.event(Trigger::kInitialised, kStays);
  if (state == State::kFault || state == State::kFaultReactionActive) {
    drive.event(Trigger::kFault, kStays);
    drive.clear_fault();
    if (state == State::kFault) drive.event(Trigger::kFaultReactionDone, kStays);
    return drive;
  }
  const std::uint16_t words[] = {kWordShutdown, kWordSwitchOn, kWordEnableOperation,
                                 kWordQuickStop};
  for (const std::uint16_t word : words) {
    if (drive.state() == state) break;
    drive.control(word, kStays);
  }
  return drive;
}

struct Command {
  std::uint8_t mask;
  std::uint8_t value;
  std::uint8_t transitions[5];
};
constexpr Command kCommands[] = {
    {0x87, 0x06, {2, 6, 8}},       // shutdown
    {0x8F, 0x07, {3, 5}},          // switch on; disable operation
    {0x8F, 0x0F, {3, 4, 16}},      // enable operation
    {0x82, 0x00, {7, 9, 10, 12}},  // disable voltage
    {0x86, 0x02, {7, 10, 11}},     // quick stop
};
struct Arrow {
  State from;
  State to;
};
constexpr Arrow kArrows[17] = {{},
                               {},
                               {State::kSwitchOnDisabled, State::kReadyToSwitchOn},
                               {State::kReadyToSwitchOn, State::kSwitchedOn},
                               {State::kSwitchedOn, State::kOperationEnabled},
                               {State::kOperationEnabled, State::kSwitchedOn},
                               {State::kSwitchedOn, State::kReadyToSwitchOn},
                               {State::kReadyToSwitchOn, State::kSwitchOnDisabled},
                               {State::kOperationEnabled, State::kReadyToSwitchOn},
                               {State::kOperationEnabled, State::kSwitchOnDisabled},
                               {State::kSwitchedOn, State::kSwitchOnDisabled},
                               {State::kOperationEnabled, State::kQuickStopActive},
                               {State::kQuickStopActive, State::kSwitchOnDisabled},
                               {},
                               {},
                               {State::kFault, State::kSwitchOnDisabled},
                               {State::kQuickStopActive, State::kOperationEnabled}};

std::uint8_t expected(State state, unsigned word, bool stays) {
  if ((word & 0x80) != 0) return state == State::kFault ? 15 : 0;
  for (const Command& command : kCommands) {
    if ((word & command.mask) != command.value) continue;
    for (const std::uint8_t number : command.transitions) {
      if (number == 0 || kArrows[number].from != state) continue;
      return number == 16 && !stays ? std::uint8_t{0} : number;
    }
  }
  return 0;
}

TEST(Drive, EveryControlwordInEveryStateMakesTheStandardsTransitionAndNoOther) {
  int made[17] = {};
  for (const State state : kAll) {
    for (unsigned word = 0; word < 0x200; ++word) {
      for (const bool stays : {true, false}) {
        Drive drive = in(state);
        ASSERT_TRUE(drive.state() == state);
        // Disable voltage makes a fault reset an edge.
        const std::uint8_t number =
            drive.control(static_cast<std::uint16_t>(word), stays ? kStays : kLeaves);
        ASSERT_EQ(number, expected(state, word, stays)) << state_text(state) << ", " << word;
        ASSERT_TRUE(drive.state() == (number == 0 ? state : kArrows[number].to));
        ++made[number];
      }
    }
  }
  for (const int number : {2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16}) {
    EXPECT_GT(made[number], 0) << number;
  }
  for (const int number : {1, 13, 14}) EXPECT_EQ(made[number], 0) << "not a controlword's";
}

TEST(Drive, EventsMakeTheirTransitionsOnly) {
  for (const State state : kAll) {
    Drive drive = in(state);
    const bool faulty = state == State::kFault || state == State::kFaultReactionActive;
    EXPECT_EQ(drive.event(Trigger::kFault, kLeaves), faulty ? 0 : 13);
    EXPECT_TRUE(drive.state() == (faulty ? state : State::kFaultReactionActive));
    drive = in(state);
    EXPECT_EQ(drive.event(Trigger::kInitialised, kLeaves), state == State::kNotReady ? 1 : 0);
    drive = in(state);
    const bool reacting = state == State::kFaultReactionActive;
    EXPECT_EQ(drive.event(Trigger::kFaultReactionDone, kLeaves), reacting ? 14 : 0);
    drive = in(state);
    const bool stopping = state == State::kQuickStopActive;
    EXPECT_EQ(drive.event(Trigger::kQuickStopDone, kLeaves), stopping ? 12 : 0);
    drive = in(state);
    EXPECT_EQ(drive.event(Trigger::kQuickStopDone, kStays), 0);
    EXPECT_EQ(drive.event(Trigger::kShutdown, kStays), 0) << "a command is no event";
  }
}

TEST(Drive, AFaultIsResetByAnEdgeAndOnlyWhenItsCauseIsGone) {
  Drive drive = in(State::kOperationEnabled);
  drive.event(Trigger::kFault, kLeaves);
  drive.event(Trigger::kFaultReactionDone, kLeaves);
  EXPECT_EQ(drive.control(kWordFaultReset, kLeaves), 0) << "the cause is still there";
  drive.clear_fault();
  EXPECT_EQ(drive.control(kWordFaultReset, kLeaves), 0) << "no edge";
  EXPECT_EQ(drive.control(0, kLeaves), 0);
  EXPECT_EQ(drive.control(kWordFaultReset, kLeaves), 15);
  EXPECT_EQ(drive.control(kWordFaultReset | kWordShutdown, kLeaves), 0)
      << "no command while the bit is set";
  EXPECT_EQ(drive.control(kWordShutdown, kLeaves), 2);
}

TEST(Drive, IsPoweredWhereTheStandardAllowsIt) {
  for (const State state : kAll) {
    const bool on = state == State::kOperationEnabled || state == State::kQuickStopActive ||
                    state == State::kFaultReactionActive;
    EXPECT_EQ(in(state).powered(), on);
  }
}

TEST(Drive, ALostConnectionDoesWhatItsOptionSays) {
  struct Row {
    AbortConnection option;
    std::uint8_t number;
  };
  for (const Row& row :
       {Row{AbortConnection::kNothing, 0}, Row{AbortConnection::kFault, 13},
        Row{AbortConnection::kDisableVoltage, 9}, Row{AbortConnection::kQuickStop, 11}}) {
    Drive drive = in(State::kOperationEnabled);
    EXPECT_EQ(drive.connection_lost(row.option, kLeaves), row.number);
  }
}

// The standard's patterns, with any other bits.
TEST(Statusword, TellsTheStateWhateverItsOtherBits) {
  for (const State state : kAll) {
    const Drive drive = in(state);
    for (unsigned noise = 0; noise < 0x10000; noise += 0x10) {
      const std::uint16_t word = drive.statusword(static_cast<std::uint16_t>(noise));
      ASSERT_TRUE(state_of(word) == state);
      ASSERT_EQ(word & 0xFF90u, noise & 0xFF90u) << "its other bits stay";
    }
  }
  const std::uint16_t known[] = {0x0000, 0x0040, 0x0021, 0x0023, 0x0027, 0x0007, 0x000F, 0x0008};
  for (unsigned i = 0; i < kStates; ++i) EXPECT_EQ(state_bits(kAll[i]), known[i]);
  EXPECT_TRUE(state_of(0x0028) == State::kFault);
  EXPECT_TRUE(state_of(0x002F) == State::kFaultReactionActive);
  EXPECT_TRUE(state_of(0x0060) == State::kSwitchOnDisabled);
  EXPECT_TRUE(state_of(0x0020) == State::kNotReady);
}

using Result = EnableSequence::Result;

// One word each way per millisecond.
Result enable(Drive& drive, std::uint64_t& now_us) {
  EnableSequence master;
  master.begin(now_us);
  for (int i = 0; i < 5000; ++i) {
    const Result result = master.update(drive.statusword(kRemote | kVoltageEnabled), now_us);
    if (result != Result::kBusy) return result;
    drive.control(master.word(), kLeaves);
    if (drive.state() == State::kFaultReactionActive) drive.event(Trigger::kFaultReactionDone, 2);
    now_us += 1000;
  }
  return Result::kBusy;
}

TEST(EnableSequence, EnablesADriveFromAnyState) {
  for (const State state : kAll) {
    if (state == State::kNotReady) continue;
    Drive drive = in(state);
    std::uint64_t now_us = 5;
    EXPECT_TRUE(enable(drive, now_us) == Result::kEnabled) << state_text(state);
    EXPECT_TRUE(drive.state() == State::kOperationEnabled);
    EXPECT_LT(now_us, 20'000u);
  }
}

TEST(EnableSequence, GivesUpOnADriveThatDoesNotMove) {
  Drive drive;  // never initialised
  std::uint64_t now_us = 0;
  EXPECT_TRUE(enable(drive, now_us) == Result::kStuck);
  EXPECT_EQ(now_us, EnableSequence::kStateTimeoutUs);
}

TEST(EnableSequence, WaitsForASlowDriveAsLongAsItMoves) {
  EnableSequence master;
  std::uint64_t now_us = 0;
  master.begin(now_us);
  for (const State state :
       {State::kNotReady, State::kSwitchOnDisabled, State::kReadyToSwitchOn, State::kSwitchedOn}) {
    EXPECT_TRUE(master.update(state_bits(state), now_us) == Result::kBusy);
    now_us += EnableSequence::kStateTimeoutUs - 1;
    EXPECT_TRUE(master.update(state_bits(state), now_us) == Result::kBusy);
  }
  EXPECT_TRUE(master.update(state_bits(State::kOperationEnabled), now_us) == Result::kEnabled);
}

TEST(EnableSequence, ResetsAFaultAFewTimesAndThenSaysSo) {
  Drive drive = in(State::kSwitchedOn);
  drive.event(Trigger::kFault, kLeaves);
  std::uint64_t now_us = 0;
  EXPECT_TRUE(enable(drive, now_us) == Result::kFaulty);
  EXPECT_TRUE(drive.state() == State::kFault);
  drive.clear_fault();
  EXPECT_TRUE(enable(drive, now_us) == Result::kEnabled) << "asked again, with the cause gone";
}

TEST(EnableSequence, NeverCommandsOperationBeforeTheDriveIsSwitchedOn) {
  for (unsigned status = 0; status < 0x10000; status += 1) {
    EnableSequence master;
    master.begin(0);
    master.update(static_cast<std::uint16_t>(status), 0);
    const State state = state_of(static_cast<std::uint16_t>(status));
    if (state == State::kSwitchedOn || state == State::kOperationEnabled) continue;
    ASSERT_NE(master.word() & kBitEnableOperation, kBitEnableOperation) << status;
  }
}

}  // namespace
}  // namespace verp::canopen::cia402
