#include "common/protocol/canopen/cia402.hpp"

namespace verp::canopen::cia402 {
namespace {

struct Row {
  std::uint8_t number;
  State from;
  Trigger trigger;
  State next;
};

// CiA 402's transitions without 13, from every state, and 12 and 16, which depend on the quick stop
// option code.
constexpr Row kRows[] = {
    {1, State::kNotReady, Trigger::kInitialised, State::kSwitchOnDisabled},
    {2, State::kSwitchOnDisabled, Trigger::kShutdown, State::kReadyToSwitchOn},
    {3, State::kReadyToSwitchOn, Trigger::kSwitchOn, State::kSwitchedOn},
    {3, State::kReadyToSwitchOn, Trigger::kEnableOperation, State::kSwitchedOn},
    {4, State::kSwitchedOn, Trigger::kEnableOperation, State::kOperationEnabled},
    {5, State::kOperationEnabled, Trigger::kSwitchOn, State::kSwitchedOn},
    {6, State::kSwitchedOn, Trigger::kShutdown, State::kReadyToSwitchOn},
    {7, State::kReadyToSwitchOn, Trigger::kDisableVoltage, State::kSwitchOnDisabled},
    {7, State::kReadyToSwitchOn, Trigger::kQuickStop, State::kSwitchOnDisabled},
    {8, State::kOperationEnabled, Trigger::kShutdown, State::kReadyToSwitchOn},
    {9, State::kOperationEnabled, Trigger::kDisableVoltage, State::kSwitchOnDisabled},
    {10, State::kSwitchedOn, Trigger::kDisableVoltage, State::kSwitchOnDisabled},
    {10, State::kSwitchedOn, Trigger::kQuickStop, State::kSwitchOnDisabled},
    {11, State::kOperationEnabled, Trigger::kQuickStop, State::kQuickStopActive},
    {12, State::kQuickStopActive, Trigger::kDisableVoltage, State::kSwitchOnDisabled},
    {14, State::kFaultReactionActive, Trigger::kFaultReactionDone, State::kFault},
    {15, State::kFault, Trigger::kFaultReset, State::kSwitchOnDisabled},
};

constexpr const char* kStateTexts[kStates] = {
    "not ready to switch on", "switch on disabled", "ready to switch on",    "switched on",
    "operation enabled",      "quick stop active",  "fault reaction active", "fault"};

}  // namespace

const char* state_text(State state) {
  return kStateTexts[static_cast<unsigned>(state)];
}

Transition transition(State state, Trigger trigger, bool stays_in_quick_stop) {
  for (const Row& row : kRows) {
    if (row.from == state && row.trigger == trigger) return {row.number, row.next};
  }
  const bool faulty = state == State::kFault || state == State::kFaultReactionActive;
  if (trigger == Trigger::kFault && !faulty) return {13, State::kFaultReactionActive};
  if (state != State::kQuickStopActive) return {0, state};
  if (trigger == Trigger::kQuickStopDone && !stays_in_quick_stop) {
    return {12, State::kSwitchOnDisabled};
  }
  if (trigger == Trigger::kEnableOperation && stays_in_quick_stop) {
    return {16, State::kOperationEnabled};
  }
  return {0, state};
}

std::uint8_t Drive::apply(Trigger trigger, std::int16_t quick_stop_option) {
  const Transition taken = transition(state_, trigger, stays_in_quick_stop(quick_stop_option));
  state_ = taken.next;
  return taken.number;
}

std::uint8_t Drive::control(std::uint16_t controlword, std::int16_t quick_stop_option) {
  const Trigger command = command_of(controlword, controlword_);
  controlword_ = controlword;
  if (command == Trigger::kFaultReset && fault_present_) return 0;
  return apply(command, quick_stop_option);
}

std::uint8_t Drive::event(Trigger trigger, std::int16_t quick_stop_option) {
  if (trigger < Trigger::kInitialised) return 0;
  if (trigger == Trigger::kFault) fault_present_ = true;
  return apply(trigger, quick_stop_option);
}

std::uint8_t Drive::connection_lost(AbortConnection option, std::int16_t quick_stop_option) {
  switch (option) {
    case AbortConnection::kFault:
      // Leaves no cause, so the next reset clears it.
      return apply(Trigger::kFault, quick_stop_option);
    case AbortConnection::kDisableVoltage:
      return apply(Trigger::kDisableVoltage, quick_stop_option);
    case AbortConnection::kQuickStop:
      return apply(Trigger::kQuickStop, quick_stop_option);
    case AbortConnection::kNothing:
      break;
  }
  return 0;
}

void EnableSequence::begin(std::uint64_t now_us) {
  *this = EnableSequence();
  since_us_ = now_us;
}

// A reset is an edge: the bit must be 0 between two. False after too many.
bool EnableSequence::reset_fault(std::uint64_t now_us) {
  if (word_ == kWordFaultReset) {
    if (now_us >= reset_us_ + kResetUs) word_ = kWordDisableVoltage;
    return true;
  }
  if (resets_ >= kMaxResets) return false;
  ++resets_;
  reset_us_ = now_us;
  word_ = kWordFaultReset;
  return true;
}

EnableSequence::Result EnableSequence::update(std::uint16_t statusword, std::uint64_t now_us) {
  if (result_ != Result::kBusy) return result_;
  const State state = state_of(statusword);
  if (state != state_) since_us_ = now_us;
  state_ = state;
  switch (state) {
    case State::kSwitchOnDisabled:
      word_ = kWordShutdown;
      break;
    case State::kReadyToSwitchOn:
      word_ = kWordSwitchOn;
      break;
    case State::kSwitchedOn:
    case State::kOperationEnabled:
      word_ = kWordEnableOperation;
      break;
    case State::kFault:
      if (!reset_fault(now_us)) return result_ = Result::kFaulty;
      break;
    case State::kNotReady:
    case State::kFaultReactionActive:
    case State::kQuickStopActive:  // leaves this state with every option code
      word_ = kWordDisableVoltage;
      break;
  }
  if (state == State::kOperationEnabled) return result_ = Result::kEnabled;
  if (now_us >= since_us_ + kStateTimeoutUs) return result_ = Result::kStuck;
  return result_;
}

}  // namespace verp::canopen::cia402
