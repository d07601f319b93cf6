#pragma once
#include <cstdint>

#include "host/twin/bus/faulty_line.hpp"
#include "tests/hil/run_result.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

using bus::FaultyLine;
using bus::LineDamage;
using bus::LineFaults;

enum class Event {
  kNone,
  kServoGone,       ///< unplugged but powered
  kServoUnpowered,  ///< unplugged; restarts later
  kRepeats,         ///< a servo reports the same position again
  kLateLoop,        ///< the controller is now and then busy for more than a period
  kReset,
  kHot,         ///< a servo is too hot but goes on
  kOverheated,  ///< so hot that a servo shuts off its torque
  kLowVoltage,
  kSags,         ///< the supply is low, only while the robot walks
  kJointBeyond,  ///< a relaxed robot's joint is turned beyond its limits
  kImuGone,      ///< unplugged from the bus
  kImuRepeats,
  kFlutters,  ///< a servo is silent for 70 ms in every 300
};

struct FaultPlan {
  const char* name;
  int runs;
  bool physics;  ///< ODE; else LevelPlant
  LineFaults line{};
  Event event = Event::kNone;
  double lasts_s = 0;  ///< 0: until the end
  double walks_s = 3;  ///< from the fault on
};

struct FaultResult : RunResult {
  LineDamage damage;
};

FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed);

}  // namespace verp::test
