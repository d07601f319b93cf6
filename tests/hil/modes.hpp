#pragma once

/// As the safety table's README numbers them, not the core's list.
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
  kGettingUp,
  kLyingDown
};
inline constexpr const char* kModeNames[] = {"relaxed", "rising",  "standing",   "walking",
                                             "holding", "sitting", "fallen",     "stopped",
                                             "acting",  "falling", "getting up", "lying down"};

}  // namespace verp::test
