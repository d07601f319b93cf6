#pragma once
#include <cstdint>

#include "tests/hil/can_faults.hpp"
#include "tests/hil/can_intruder.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

/// What goes wrong besides the frames.
enum class CanEvent : std::uint8_t {
  kNone,
  kNodeSilent,     ///< unplugged from the bus, not from its power
  kNodeUnpowered,  ///< unplugged: back again, it starts anew
  kNodeReboots,    ///< as after a dip of its supply
  kManyReboot,     ///< one after another
  kAllReboot,      ///< drives and sensors: their power was off and is on again
  kImuReboots,
  kFootReboots,
  kRepeats,      ///< tells the same position again and again
  kLateLoop,     ///< the controller is busy elsewhere for longer than a period, now and then
  kReset,        ///< the controller starts anew
  kHot,          ///< a drive is hotter than it should, and goes on
  kOverheated,   ///< so hot that it shuts its torque off
  kLowVoltage,   ///< the supply is low
  kSags,         ///< likewise, but only while the robot walks
  kJointBeyond,  ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,      ///< unplugged from the bus
  kImuRepeats,   ///< tells the same reading again and again
  kBusOff,       ///< of the controller's chip, once
  kBusOffs,      ///< again and again, as long as it lasts
  kShort,        ///< the bus's wires touch each other
};

struct CanPlan {
  const char* name;
  int runs;
  CanFaults line{};
  CanEvent event = CanEvent::kNone;
  Intruder::Kind intruder = Intruder::Kind::kSilent;
  double lasts_s = 0;    ///< 0: to the end
  double walks_s = 2;    ///< from the fault's beginning to the end of the run
  bool physics = false;  ///< ODE, where falling matters; else LevelPlant
  bool chip = false;     ///< the controller's bus is bxCAN's driver on the model of its registers
};

struct CanFaultResult : RunResult {
  CanDamage damage;
  hal::CanErrors bus;                ///< at the controller's end
  std::uint32_t intruder = 0;        ///< frames of the intruder
  std::uint64_t digest = 0;          ///< of the last tick, chained
  std::uint64_t ticks_recorded = 0;  ///< of which each has its digest in a replay too
  std::uint32_t faults() const { return damage.faults() + events + intruder; }
};

/// One robot that stands up, walks, and meets a fault. Everything in it comes from `seed`.
CanFaultResult run_can_fault(const Robot& robot, const CanPlan& plan, std::uint32_t seed);

}  // namespace verp::test
