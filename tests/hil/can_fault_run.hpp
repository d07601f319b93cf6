#pragma once
#include <cstdint>

#include "tests/hil/can_faults.hpp"
#include "tests/hil/can_intruder.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

enum class CanEvent : std::uint8_t {
  kNone,
  kNodeSilent,     ///< unplugged but powered
  kNodeUnpowered,  ///< unplugged; restarts later
  kNodeReboots,    ///< after a dip of its supply
  kManyReboot,     ///< one after another
  kAllReboot,      ///< all drives and sensors, for a moment
  kImuReboots,
  kFootReboots,
  kRepeats,   ///< a drive reports the same position again
  kLateLoop,  ///< the controller is now and then busy for more than a period
  kReset,
  kHot,         ///< a drive is too hot but goes on
  kOverheated,  ///< so hot that a drive shuts off its torque
  kLowVoltage,
  kSags,         ///< the supply is low, only while the robot walks
  kJointBeyond,  ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,      ///< unplugged from the bus
  kImuRepeats,
  kBusOff,    ///< the controller's chip, once
  kBusOffs,   ///< while the fault lasts
  kShort,     ///< the bus wires are shorted
  kFlutters,  ///< a node is silent for 70 ms in every 300
};

struct CanPlan {
  const char* name;
  int runs;
  CanFaults line{};
  CanEvent event = CanEvent::kNone;
  Intruder::Kind intruder = Intruder::Kind::kSilent;
  double lasts_s = 0;    ///< 0: until the end
  double walks_s = 2;    ///< from the fault on
  bool physics = false;  ///< ODE; else LevelPlant
  bool chip = false;     ///< bxCAN's driver on its register model
};

struct CanFaultResult : RunResult {
  CanDamage damage;
  hal::CanErrors bus;                ///< at the controller's end
  std::uint32_t intruder = 0;        ///< its frames
  std::uint64_t digest = 0;          ///< after the last tick
  std::uint64_t ticks_recorded = 0;  ///< repeated by a replay
  std::uint32_t faults() const { return damage.faults() + events + intruder; }
};

CanFaultResult run_can_fault(const Robot& robot, const CanPlan& plan, std::uint32_t seed);

}  // namespace verp::test
