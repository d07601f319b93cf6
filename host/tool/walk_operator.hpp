#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "firmware/app/contracts.hpp"

namespace verp::tool {

/// The person at the desk during `verp walk`: asks the robot to stand, lets it walk once it stands,
/// and says stop in time for the gait to be over after walk_s. Sees what the controller reports,
/// never the twin's truth.
class WalkOperator {
 public:
  /// `velocity` holds vx, vy, wz of the walk; its other members are ignored.
  WalkOperator(const Params& params, const Command& velocity, double walk_s);

  app::OperatorOrder order(std::uint32_t tick);
  /// What the controller put out in the tick just done.
  void observe(std::uint32_t tick, const Outputs& outputs);

  /// The gait is over, or will never come: `failed()` then says why.
  bool done() const { return done_; }
  /// Empty unless the robot would not stand up or stop; faults and falls are in Outputs.
  const char* failed() const { return failed_; }
  /// Seconds of gait so far.
  double walked_s() const { return walked_s_; }

 private:
  double stop_lead_s() const;

  const Params& params_;
  Command velocity_;
  double walk_s_;
  Command command_;
  double period_s_;
  double walked_s_ = 0;
  double waited_s_ = 0;    ///< before the gait
  double stood_s_ = 0;     ///< standing, before the gait
  double idle_s_ = 0;      ///< without gait, though nobody said stop
  double stopping_s_ = 0;  ///< since stop was said
  bool gait_seen_ = false, stopping_ = false, done_ = false;
  const char* failed_ = "";
};

}  // namespace verp::tool
