#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/contracts.hpp"
#include "host/run/session/get_up.hpp"

namespace verp::session {

/// The person at the desk during `verp walk`: asks the robot to stand, lets it walk once it stands,
/// and says stop in time for the gait to be over after walk_s, or in the last step before that.
/// Sees what the controller reports and plans, never the twin's truth.
class WalkOperator {
 public:
  /// `velocity` holds vx, vy, wz of the walk; its other members are ignored. `get_ups`: how often
  /// in a row it asks a robot that lies to get up; one that then stands walks on. `stands`: it is
  /// asked to stand for so long, and never to walk.
  WalkOperator(const Params& params, const Command& velocity, double walk_s, int get_ups = 0,
               bool stands = false);

  app::OperatorOrder order(std::uint32_t tick);
  /// What the controller put out in the tick just done, and what it plans.
  void observe(const State& state, const Outputs& outputs);

  /// The gait is over, or will never come: `failed()` then says why.
  bool done() const { return done_; }
  /// Empty unless the robot would not stand up or stop; faults and falls are in Outputs.
  const char* failed() const { return failed_; }
  /// Seconds of gait so far; of one who stands, since it stood quietly.
  double walked_s() const { return walked_s_; }
  /// Stop was said as soon as the gait began, and still it is longer than walk_s.
  bool longer_than_asked() const { return longer_than_asked_; }

 private:
  double lead_s(const State& state, bool one_more) const;
  void stop_in_time(const State& state);
  bool look_after_fall(safety::Mode mode);
  bool knows_gyro(float still_s) const;
  void wait_for_stand(const State& state, bool standing);
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
  double stood_s_ = 0;     ///< standing with its gyro known, before the gait
  double idle_s_ = 0;      ///< without gait, though nobody said stop
  double stopping_s_ = 0;  ///< since stop was said
  double lead_s_ = 0;      ///< length of the gait's rest when stop was said
  bool gait_seen_ = false, stopping_ = false, done_ = false;
  bool changed_ = true;  ///< the order, since it was given last
  bool could_walk_on_ = false, longer_than_asked_ = false;
  const char* failed_ = "";
};

}  // namespace verp::session
