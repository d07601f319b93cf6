#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "host/bus/lockstep_server.hpp"
#include "host/bus/realtime_server.hpp"
#include "host/tool/walk_run.hpp"

namespace verp::tool {

/// How the twin lets time go on.
enum class HilPace {
  kAuto,      ///< lockstep if the controller announces it, else by the wall's clock
  kLockstep,  ///< time stands until a controller announces lockstep
  kRealTime,  ///< by the wall's clock; lockstep is refused
};

struct HilOptions {
  std::string link;           ///< where the controller's servo bus is
  std::string operator_link;  ///< where its operator's port is; empty: somebody else gives orders
  HilPace pace = HilPace::kAuto;
};

/// What came from a CAN interface.
struct CanFrames {
  std::uint64_t heard = 0;
  std::uint32_t dropped = 0;  ///< of these, or before: faster than the simulated wire, or this PC
  std::uint64_t skipped_us = 0;  ///< of the clock: where this PC was slower than it
};

struct HilResult {
  WalkResult walk;
  bool device_trouble = false;  ///< walk.failure is the link's or the controller's
  bool lay_down = false;        ///< the robot was let go, and lies
  bool real_time = false;
  std::uint64_t compared = 0;  ///< ticks whose digest the controller told, equal to this PC's
  std::uint32_t losses = 0;    ///< times the link was lost
  std::uint32_t overruns = 0;  ///< bytes, or CAN frames, that found no room at this PC
  std::uint32_t resets = 0;    ///< times a controller began anew on a robot that was under way
  bus::LockstepServer::Counters lockstep;
  bus::RealtimeServer::Counters realtime;
  std::optional<CanFrames> can;  ///< over CAN in real time

  double ticks_per_s() const {
    return walk.wall_s > 0 ? static_cast<double>(walk.ticks) / walk.wall_s : 0;
  }
};

/// The twin of plan.entity answers a controller at the other end of a link. With an operator link
/// it walks as walk() does, and holds every tick of the controller against this PC's; without one
/// it serves for plan.walk_s from the first torque on (WalkSession::watch) and scores what the twin
/// did. Throws what opening a link throws.
HilResult serve_controller(const WalkPlan& plan, const HilOptions& options,
                           record::TraceWriter* trace, Progress& progress, bool keep_series);

}  // namespace verp::tool
