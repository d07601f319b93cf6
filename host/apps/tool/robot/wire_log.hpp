#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/run/session/plan.hpp"

namespace verp::tool {

/// One sender's bytes on the twin's bus, or one CAN frame.
struct WirePacket {
  double begin_us = 0, end_us = 0;  ///< of the line's time
  bool board = false;               ///< the controller sends
  int tick = -1;                    ///< -1: before the first tick
  std::string name;                 ///< "sync read 132", "answer 5", "RPDO1 7"
  std::vector<std::uint8_t> bytes;
  double us() const { return end_us - begin_us; }
};

/// The packets on the twin's bus until tick `end_tick` has begun, in order of time. `silent`: no
/// device answers, so the bring-up fails. Throws session::NotUp if it fails otherwise.
std::vector<WirePacket> log_wire(const session::WalkPlan& plan, int end_tick, bool silent);

}  // namespace verp::tool
