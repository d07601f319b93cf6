#pragma once

/// The modes of the safety table as its page numbers them: not the core's own list, which is what
/// referees hold to account.
namespace verp::test {

enum Mode {
  kRelaxed,
  kRising,
  kStanding,
  kWalking,
  kHolding,
  kSitting,
  kFallen,
  kStopped,
  kActing,
  kFalling,
  kGettingUp
};
inline constexpr const char* kModeNames[] = {"relaxed", "rising",  "standing",  "walking",
                                             "holding", "sitting", "fallen",    "stopped",
                                             "acting",  "falling", "getting up"};

}  // namespace verp::test
