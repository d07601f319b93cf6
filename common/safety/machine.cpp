#include "common/safety/machine.hpp"

namespace verp::safety {
namespace {

constexpr std::uint32_t bit(Mode mode) {
  return 1U << static_cast<unsigned>(mode);
}
constexpr std::uint32_t kAny = (1U << kModes) - 1U;
constexpr std::uint32_t kUpright = bit(Mode::kRising) | bit(Mode::kStanding) | bit(Mode::kWalking) |
                                   bit(Mode::kHolding) | bit(Mode::kSitting) | bit(Mode::kActing);
constexpr std::uint32_t kMoving =
    bit(Mode::kRising) | bit(Mode::kStanding) | bit(Mode::kWalking) | bit(Mode::kActing);
constexpr std::uint32_t kMayFall = kMoving | bit(Mode::kSitting);
constexpr std::uint32_t kMayRest = bit(Mode::kRising) | bit(Mode::kStanding) | bit(Mode::kHolding);

}  // namespace

constexpr Row kTable[] = {
    // Emergencies.
    {kAny & ~bit(Mode::kStopped), kEmergency, 0, Mode::kStopped},
    {bit(Mode::kStopped), kAskRelax, kEmergency, Mode::kRelaxed},
    {kUpright, kFell, 0, Mode::kFallen},
    {bit(Mode::kFallen), kAskRelax, 0, Mode::kRelaxed},
    // Silence: hold, then sit, then release torque. Sit at once on a relax request or power
    // trouble.
    {kMoving | bit(Mode::kGettingUp), kStale, 0, Mode::kHolding},
    {bit(Mode::kHolding), kLost, 0, Mode::kSitting},
    {kMayRest, kAskRelax, 0, Mode::kSitting},
    {kMayRest, kTrouble, kStale, Mode::kSitting},
    {bit(Mode::kHolding), 0, kStale, Mode::kRising},
    {bit(Mode::kStanding), kOperatorGone, 0, Mode::kSitting},
    {bit(Mode::kRelaxed), kAskStand | kServosKnown,
     kFell | kStale | kOperatorQuiet | kTrouble | kJointBeyond, Mode::kRising},
    {bit(Mode::kRising), kTimeUp, 0, Mode::kStanding},
    {bit(Mode::kStanding), kAskWalk | kCalibrated, kOperatorQuiet, Mode::kWalking},
    {bit(Mode::kStanding), kPushed | kCalibrated, kOperatorQuiet, Mode::kWalking},
    {bit(Mode::kWalking), kGaitOver, kAskWalk | kPushed, Mode::kStanding},
    {bit(Mode::kWalking), kGaitOver | kOperatorQuiet, 0, Mode::kStanding},
    {bit(Mode::kWalking), kGaitOver | kTrouble, 0, Mode::kStanding},
    {bit(Mode::kSitting), kTimeUp, kLiesDown, Mode::kRelaxed},
    // A stopped action first returns to the stand.
    {bit(Mode::kStanding), kAskAction | kCalibrated, kOperatorQuiet | kTrouble, Mode::kActing},
    {bit(Mode::kActing), kTimeUp, 0, Mode::kStanding},
    // A fall comes last: an earlier row hides it for one tick only.
    {kMayFall, kFallSeen, kStale, Mode::kFalling},
    {bit(Mode::kFalling), kTimeUp | kFell, 0, Mode::kFallen},
    {bit(Mode::kFalling), kTimeUp, 0, Mode::kHolding},
    {bit(Mode::kFallen) | bit(Mode::kRelaxed), kAskGetUp | kServosKnown,
     kStale | kOperatorQuiet | kTrouble | kJointBeyond, Mode::kGettingUp},
    {bit(Mode::kGettingUp), kTimeUp | kFell, 0, Mode::kFallen},
    {bit(Mode::kGettingUp), kTimeUp, 0, Mode::kStanding},
    // On the floor torque may go.
    {bit(Mode::kSitting), kTimeUp | kLiesDown, 0, Mode::kLyingDown},
    {bit(Mode::kLyingDown), kTimeUp, 0, Mode::kRelaxed},
};
constexpr int kRows = sizeof(kTable) / sizeof(Row);

Mode next_mode(Mode mode, std::uint32_t conditions) {
  for (const Row& row : kTable) {
    if ((row.from & bit(mode)) != 0 && (conditions & row.all_of) == row.all_of &&
        (conditions & row.none_of) == 0) {
      return row.to;
    }
  }
  return mode;
}

}  // namespace verp::safety
