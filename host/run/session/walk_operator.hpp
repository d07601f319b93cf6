#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/contracts.hpp"
#include "host/run/session/get_up.hpp"

namespace verp::session {

/// Operator of `verp walk`: stand, then walk. It stops the gait at walk_s or in the last step
/// before. It sees only the controller's reports and plans.
class WalkOperator {
 public:
  /// `velocity`: only vx, vy, wz. `get_ups`: attempts in a row; the robot then walks on. `stands`:
  /// stands for that time.
  WalkOperator(const Params& params, const Command& velocity, double walk_s, int get_ups = 0,
               bool stands = false);

  app::OperatorOrder order(std::uint32_t tick);
  void observe(const State& state, const Outputs& outputs);

  /// The gait is over or never starts: failed().
  bool done() const { return done_; }
  /// Reason if it would not stand up or stop; faults and falls are in Outputs.
  const std::string& failed() const { return failed_; }
  /// Seconds of gait; with `stands`, seconds since it stood quietly.
  double walked_s() const { return walked_s_; }
  /// The gait is longer than walk_s although the stop was ordered at its start.
  bool longer_than_asked() const { return longer_than_asked_; }

 private:
  double lead_s(const State& state, bool one_more) const;
  void stop_in_time(const State& state);
  bool look_after_fall(safety::Mode mode);
  bool knows_gyro(float still_s) const;
  void wait_for_stand(const State& state, const Outputs& outputs, bool standing);
  void watch_stand(bool standing);
  void watch_walk(const State& state, const Outputs& outputs, bool standing);

  const Params& params_;
  Command velocity_;
  double walk_s_;
  Command command_;
  double period_s_;
  GetUp get_up_;
  bool stands_;
  double walked_s_ = 0;
  double waited_s_ = 0;    ///< before the gait
  double standing_s_ = 0;  ///< before the gait
  double stood_s_ = 0;     ///< standing with a calibrated gyro, before the gait
  double idle_s_ = 0;      ///< without gait, before the stop
  double stopping_s_ = 0;
  double lead_s_ = 0;  ///< remaining gait at the stop
  bool gait_seen_ = false, stopping_ = false, done_ = false;
  bool changed_ = true;
  bool could_walk_on_ = false, longer_than_asked_ = false;
  std::string failed_;
};

}  // namespace verp::session
