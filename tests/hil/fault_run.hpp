#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "common/protocol/controller_table.hpp"
#include "tests/hil/line_faults.hpp"
#include "tests/target/twin_run.hpp"

namespace verp::test {

/// What goes wrong besides the line.
enum class Event {
  kNone,
  kServoGone,       ///< unplugged from the bus, not from its power
  kServoUnpowered,  ///< unplugged: back again, it starts anew
  kServoRepeats,    ///< tells the same position again and again
  kLateLoop,        ///< the controller is busy elsewhere for longer than a period, now and then
  kReset,           ///< the controller starts anew
  kHot,             ///< a servo is hotter than it should, and goes on
  kOverheated,      ///< so hot that it shuts its torque off
  kLowVoltage,      ///< the supply sags
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

/// What the operator sees of a controller.
struct Registers {
  std::uint8_t mode = 0, reset_cause = 0;
  std::uint32_t tick = 0, faults = 0, fresh = 0;
  std::uint32_t crc_errors = 0, timeouts = 0, strays = 0, noise = 0, overruns = 0, misses = 0;
  std::array<dxl::controller::DeviceState, dxl::controller::kDevices> state{};
  std::array<std::uint16_t, dxl::controller::kDevices> age{};
  std::array<std::uint32_t, dxl::controller::kDevices> errors{};

  std::uint32_t counted() const { return crc_errors + timeouts + strays + noise + misses; }
};

struct FaultResult {
  std::string violation;  ///< of the safety table, or of another promise; empty: none
  LineDamage damage;      ///< of the line
  std::uint32_t events = 0;
  int joint = 0;                    ///< whose servo the event was about
  Registers before;                 ///< when the fault began
  Registers during;                 ///< when it ended
  Registers after;                  ///< at the end
  std::uint32_t seen = 0;           ///< bit m: was in mode m
  std::uint32_t walking_ticks = 0;  ///< since the fault began
  std::uint32_t ticks = 0;          ///< likewise
  std::uint64_t worst_tick_us = 0;  ///< bus time
  double distance_m = 0;            ///< over ground, physics only
  bool stale = false;               ///< a servo or the IMU was silent for stale_hold_s
  bool fallen = false;
  bool ready = false;  ///< the controller came up, and walked before the fault
};

/// One robot that stands up, walks, and meets a fault. Everything in it comes from `seed`.
FaultResult run_fault(const Robot& robot, const FaultPlan& plan, std::uint32_t seed);

}  // namespace verp::test
