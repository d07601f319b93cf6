#pragma once

/// The safety table's modes as its README numbers them, not the core's list, which referees judge.
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
