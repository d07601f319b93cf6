#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "firmware/app/contracts.hpp"
#include "host/bus/virtual_bus.hpp"
#include "host/can/virtual_can.hpp"
#include "host/record/trace_writer.hpp"
#include "host/sim/metrics.hpp"
#include "host/sim/robot.hpp"
#include "host/tool/fall_verdict.hpp"
#include "host/tool/progress.hpp"
#include "host/tool/walk_operator.hpp"
#include "host/tool/walk_run.hpp"

namespace verp::tool {

/// Twin, bus, operator, meter and trace of one walk; the controller is somewhere else. A Recorder
/// for it.
class WalkSession {
 public:
  /// `trace` may be null. The plan and the other references must outlive the session.
  WalkSession(const WalkPlan& plan, record::TraceWriter* trace, Progress& progress,
              std::string label, bool keep_series);

  /// The bus that the plan's Params speak of; the other one is not there.
  bus::VirtualBus& bus() { return *bus_; }
  can::VirtualCan& can() { return *can_; }
  WalkOperator& walker() { return *walker_; }
  /// The controller began anew, on the robot as it is: the operator has it stand up and walk for
  /// what is left of the time. The trace ends before: a tick has no other one to follow there.
  void begin_anew();
  /// The walk has ended, or somebody interrupts.
  bool over() const;

  /// A tick of the controller, wherever it ran.
  void record(const TickRecord& tick, const State& state, const Outputs& outputs);
  /// A tick of a controller that tells nothing of itself: only what the twin did is scored. The
  /// session begins when a servo first has torque, not when somebody looks for servos, and has
  /// plan.walk_s from then on. It ends sooner if the robot falls; one that is let go may lie down
  /// (FallVerdict), and is served on.
  void watch();

  double simulated_s() const;
  bool fallen() const { return robot_.fallen(); }
  /// Of what was watched.
  const FallVerdict& verdict() const { return verdict_; }

  /// Once, at the end. `failure` says what went wrong besides the walk; empty: nothing.
  WalkResult result(double wall_s, std::string failure);

 private:
  void append(const TickRecord& tick, const State& state, std::uint32_t faults,
              const sim::Transform& body_world);
  std::string failure_of_walk() const;
  void count_traffic();
  double walked_s() const;
  bool has_torque();

  const WalkPlan& plan_;
  record::TraceWriter* trace_;
  Progress& progress_;
  std::string label_;
  sim::World world_;
  sim::TwinRobot robot_;
  std::optional<bus::VirtualBus> bus_;
  std::optional<can::VirtualCan> can_;
  std::optional<WalkOperator> walker_;
  double walked_s_ = 0;  ///< by controllers that are no more
  sim::WalkMeter meter_;
  WalkResult result_;
  std::uint64_t bits_before_ = 0, bare_bits_before_ = 0;  ///< the first tick
  FallVerdict verdict_;
  double begun_s_ = 0;  ///< when torque was first seen, in simulated time
  double after_s_ = 0;
  bool over_ = false;
  bool watched_ = false;
};

}  // namespace verp::tool
