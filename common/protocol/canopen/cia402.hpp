#pragma once
#include <cstdint>

/// Drives' state machine, CiA 402 (IEC 61800-7-201): controlword (6040h) and statusword (6041h),
/// both sides, with the standard's transition numbers.
namespace verp::canopen::cia402 {

enum class State : std::uint8_t {
  kNotReady,
  kSwitchOnDisabled,
  kReadyToSwitchOn,
  kSwitchedOn,
  kOperationEnabled,
  kQuickStopActive,
  kFaultReactionActive,
  kFault,
};
inline constexpr unsigned kStates = 8;
const char* state_text(State state);

inline constexpr std::uint16_t kBitSwitchOn = 1 << 0;
inline constexpr std::uint16_t kBitEnableVoltage = 1 << 1;
inline constexpr std::uint16_t kBitQuickStop = 1 << 2;  ///< 0 stops
inline constexpr std::uint16_t kBitEnableOperation = 1 << 3;
inline constexpr std::uint16_t kBitFaultReset = 1 << 7;  ///< effective on its rising edge

inline constexpr std::uint16_t kWordDisableVoltage = 0x0000;
inline constexpr std::uint16_t kWordQuickStop = 0x0002;
inline constexpr std::uint16_t kWordShutdown = 0x0006;
inline constexpr std::uint16_t kWordSwitchOn = 0x0007;  ///< or "disable operation"
inline constexpr std::uint16_t kWordEnableOperation = 0x000F;
inline constexpr std::uint16_t kWordFaultReset = 0x0080;

// Other bits of the statusword.
inline constexpr std::uint16_t kVoltageEnabled = 1 << 4;
inline constexpr std::uint16_t kWarning = 1 << 7;
inline constexpr std::uint16_t kRemote = 1 << 9;  ///< the drive obeys the controlword
inline constexpr std::uint16_t kInternalLimit = 1 << 11;
inline constexpr std::uint16_t kFollowsCommand = 1 << 12;  ///< cyclic modes: the target is used
inline constexpr std::uint16_t kFollowingError = 1 << 13;  ///< cyclic position mode

/// The statusword's state bits: 0 to 3, 5, 6.
constexpr std::uint16_t state_bits(State state) {
  constexpr std::uint16_t kBits[kStates] = {0x00, 0x40, 0x21, 0x23, 0x27, 0x07, 0x0F, 0x08};
  return kBits[static_cast<unsigned>(state)];
}
/// Unknown bits give kNotReady, in which a master waits. Bit 5 (quick stop) counts only where the
/// standard says so.
constexpr State state_of(std::uint16_t statusword) {
  const unsigned low = statusword & 0x4Fu;
  if (low == 0x40) return State::kSwitchOnDisabled;
  if (low == 0x0F) return State::kFaultReactionActive;
  if (low == 0x08) return State::kFault;
  switch (statusword & 0x6Fu) {
    case 0x21:
      return State::kReadyToSwitchOn;
    case 0x23:
      return State::kSwitchedOn;
    case 0x27:
      return State::kOperationEnabled;
    case 0x07:
      return State::kQuickStopActive;
    default:
      return State::kNotReady;
  }
}

/// A controlword's command or an internal event.
enum class Trigger : std::uint8_t {
  kShutdown,
  kSwitchOn,         ///< if operation is enabled: "disable operation"
  kEnableOperation,  ///< if not switched on: switch on first
  kDisableVoltage,
  kQuickStop,
  kFaultReset,
  kNone,         ///< no command
  kInitialised,  ///< this and the following are events
  kQuickStopDone,
  kFault,
  kFaultReactionDone,
};

/// A fault reset is an edge and has priority.
constexpr Trigger command_of(std::uint16_t controlword, std::uint16_t previous) {
  if ((controlword & ~previous & kBitFaultReset) != 0) return Trigger::kFaultReset;
  if ((controlword & kBitFaultReset) != 0) return Trigger::kNone;  // other commands have a 0 there
  if ((controlword & kBitEnableVoltage) == 0) return Trigger::kDisableVoltage;
  if ((controlword & kBitQuickStop) == 0) return Trigger::kQuickStop;
  if ((controlword & kBitSwitchOn) == 0) return Trigger::kShutdown;
  return (controlword & kBitEnableOperation) != 0 ? Trigger::kEnableOperation : Trigger::kSwitchOn;
}

struct Transition {
  std::uint8_t number = 0;  ///< 0: no transition
  State next = State::kNotReady;
};
/// `stays_in_quick_stop`: quick stop option code 5 to 8, which waits in kQuickStopActive and may be
/// enabled from there.
Transition transition(State state, Trigger trigger, bool stays_in_quick_stop);

/// Quick stop option code, object 605Ah.
constexpr bool stays_in_quick_stop(std::int16_t option) {
  return option >= 5 && option <= 8;
}

/// Object 6007h: reaction to a lost master heartbeat (1016h) or bus.
enum class AbortConnection : std::int16_t {
  kNothing = 0,
  kFault = 1,
  kDisableVoltage = 2,
  kQuickStop = 3
};

class Drive {
 public:
  State state() const { return state_; }
  /// True if torque is on.
  bool powered() const {
    return state_ == State::kOperationEnabled || state_ == State::kQuickStopActive ||
           state_ == State::kFaultReactionActive;
  }
  /// `bits`: those other than the state's.
  std::uint16_t statusword(std::uint16_t bits) const {
    return static_cast<std::uint16_t>((bits & ~0x6F) | state_bits(state_));
  }

  /// Call for each controlword, changed or not: 000Fh in kReadyToSwitchOn first switches on, the
  /// next enables. Returns the transition's number, or 0.
  std::uint8_t control(std::uint16_t controlword, std::int16_t quick_stop_option);
  /// kInitialised, kQuickStopDone, kFault or kFaultReactionDone. A fault cannot be reset before
  /// clear_fault().
  std::uint8_t event(Trigger trigger, std::int16_t quick_stop_option);
  /// Call when the fault's cause is gone.
  void clear_fault() { fault_present_ = false; }
  std::uint8_t connection_lost(AbortConnection option, std::int16_t quick_stop_option);

 private:
  std::uint8_t apply(Trigger trigger, std::int16_t quick_stop_option);
  State state_ = State::kNotReady;
  std::uint16_t controlword_ = 0;
  bool fault_present_ = false;
};

/// Brings a drive to operation enabled from any state, or reports why not.
class EnableSequence {
 public:
  enum class Result : std::uint8_t {
    kBusy,
    kEnabled,
    kStuck,   ///< a state did not change in time
    kFaulty,  ///< the fault outlasted kMaxResets resets
  };
  static constexpr std::uint64_t kStateTimeoutUs = 1'000'000;
  static constexpr std::uint64_t kResetUs = 200'000;  ///< between resets
  static constexpr std::uint8_t kMaxResets = 3;

  void begin(std::uint64_t now_us);
  /// word() is then the controlword to send. A drive that leaves operation is not brought back
  /// before begin().
  Result update(std::uint16_t statusword, std::uint64_t now_us);
  std::uint16_t word() const { return word_; }
  State state() const { return state_; }
  Result result() const { return result_; }

 private:
  bool reset_fault(std::uint64_t now_us);
  State state_ = State::kNotReady;
  Result result_ = Result::kBusy;
  std::uint16_t word_ = kWordDisableVoltage;
  std::uint8_t resets_ = 0;
  std::uint64_t since_us_ = 0;
  std::uint64_t reset_us_ = 0;
};

}  // namespace verp::canopen::cia402
