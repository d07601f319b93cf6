#pragma once
#include <cstdint>

#include "tests/hil/line_faults.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

/// What goes wrong besides the line.
enum class Event {
  kNone,
  kServoGone,       ///< unplugged from the bus, not from its power
  kServoUnpowered,  ///< unplugged: back again, it starts anew
  kRepeats,         ///< tells the same position again and again
  kLateLoop,        ///< the controller is busy elsewhere for longer than a period, now and then
  kReset,           ///< the controller starts anew
  kHot,             ///< a servo is hotter than it should, and goes on
  kOverheated,      ///< so hot that it shuts its torque off
  kLowVoltage,      ///< the supply is low
  kSags,            ///< likewise, but only while the robot walks
  kJointBeyond,     ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,         ///< unplugged from the bus
  kImuRepeats,      ///< tells the same reading again and again
};

struct FaultPlan {
  const char* name;
  int runs;
  bool physics;  ///< ODE, where falling matters; else LevelPlant
  LineFaults line{};
  Event event = Event::kNone;
  double lasts_s = 0;  ///< 0: to the end
  double walks_s = 3;  ///< from the fault's beginning to the end of the run
};

struct FaultResult : RunResult {
  LineDamage damage;  ///< of the line
};

/// One robot that stands up, walks, and meets a fault. Everything in it comes from `seed`.
FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed);

}  // namespace verp::test
