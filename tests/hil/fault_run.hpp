#pragma once
#include <cstdint>

#include "tests/hil/line_faults.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

/// Events besides faults of the line.
enum class Event {
  kNone,
  kServoGone,       ///< unplugged from the bus but powered
  kServoUnpowered,  ///< unplugged; restarts when it is back
  kRepeats,         ///< repeats the same position
  kLateLoop,        ///< now and then the controller is busy for more than a period
  kReset,
  kHot,         ///< a servo is too hot but goes on
  kOverheated,  ///< so hot that it shuts off its torque
  kLowVoltage,
  kSags,         ///< low only while the robot walks
  kJointBeyond,  ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,      ///< unplugged from the bus
  kImuRepeats,
};

struct FaultPlan {
  const char* name;
  int runs;
  bool physics;  ///< ODE, where falls matter; else LevelPlant
  LineFaults line{};
  Event event = Event::kNone;
  double lasts_s = 0;  ///< 0: until the end
  double walks_s = 3;  ///< from the fault's beginning to the run's end
};

struct FaultResult : RunResult {
  LineDamage damage;  ///< done to the line
};

/// Everything derives from `seed`.
FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed);

}  // namespace verp::test
