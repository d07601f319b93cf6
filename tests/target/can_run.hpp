#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "host/run/shadow/live_check.hpp"
#include "host/twin/can/lockstep_server.hpp"
#include "host/twin/can/virtual_can.hpp"
#include "tests/target/twin_run.hpp"

/// The loop is on an emulated board, drives and sensors on a virtual bus, frames on vcan0. Needs
/// tests/support/with-can.
namespace verp::test {

struct CanRun {
  std::vector<TickRecord> records;
  can::LockstepServer::Counters counters;
  double ticks_per_s = 0;      ///< wall time, without bring-up
  double frames_per_tick = 0;  ///< on vcan0, with the clock's
};

struct CanTwin {
  Robot robot = load_robot("generic21", "can");
  sim::World world;
  sim::TwinRobot body{world, robot.entity};
  can::VirtualCan bus{robot.params, body};
  Hands hands{world, body};
};

/// Throws BoardError if the script does not end well or frames were lost here. `check` listens on
/// vcan0.
CanRun run_over_can(const std::string& board, CanTwin& twin, const Script& script,
                    shadow::LiveCheck* check = nullptr);
CanRun run_over_can(const std::string& board, const Params& params, can::VirtualCan& bus,
                    const Script& script, shadow::LiveCheck* check = nullptr);

/// In this process, over the same CANopen binding. Empty if it did not come up.
std::vector<TickRecord> run_can_here(CanTwin& twin, const Script& script);

}  // namespace verp::test
