#pragma once
#include <cstdint>

#include "tests/hil/can_faults.hpp"
#include "tests/hil/can_intruder.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

/// Events besides faults of frames.
enum class CanEvent : std::uint8_t {
  kNone,
  kNodeSilent,     ///< unplugged from the bus but powered
  kNodeUnpowered,  ///< unplugged; restarts when it is back
  kNodeReboots,    ///< after a dip of its supply
  kManyReboot,     ///< one after another
  kAllReboot,      ///< all drives and sensors lost power for a moment
  kImuReboots,
  kFootReboots,
  kRepeats,   ///< repeats the same position
  kLateLoop,  ///< now and then the controller is busy for more than a period
  kReset,
  kHot,         ///< a drive is too hot but goes on
  kOverheated,  ///< so hot that it shuts off its torque
  kLowVoltage,
  kSags,         ///< low only while the robot walks
  kJointBeyond,  ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,      ///< unplugged from the bus
  kImuRepeats,
  kBusOff,   ///< the controller's chip, once
  kBusOffs,  ///< repeatedly while the fault lasts
  kShort,    ///< the bus wires are shorted
};

struct CanPlan {
  const char* name;
  int runs;
  CanFaults line{};
  CanEvent event = CanEvent::kNone;
  Intruder::Kind intruder = Intruder::Kind::kSilent;
  double lasts_s = 0;    ///< 0: until the end
  double walks_s = 2;    ///< from the fault's beginning to the run's end
  bool physics = false;  ///< ODE, where falls matter; else LevelPlant
  bool chip = false;     ///< uses the bxCAN driver on its register model
};

struct CanFaultResult : RunResult {
  CanDamage damage;
  hal::CanErrors bus;                ///< at the controller's end
  std::uint32_t intruder = 0;        ///< the intruder's frames
  std::uint64_t digest = 0;          ///< chained, after the last tick
  std::uint64_t ticks_recorded = 0;  ///< ticks whose digests a replay repeats
  std::uint32_t faults() const { return damage.faults() + events + intruder; }
};

/// Everything derives from `seed`.
CanFaultResult run_can_fault(const Robot& robot, const CanPlan& plan, std::uint32_t seed);

}  // namespace verp::test
