#pragma once
#include <cstdint>
#include <optional>

#include "common/control/state.hpp"
#include "host/twin/sim/truth.hpp"

/// What the controller believes of its body, held against the twin's truth.
namespace verp::session {

/// Over the ticks of the gait, up to a fall. Root mean squares, and the largest error of any tick.
struct EstimateErrors {
  std::uint64_t ticks = 0;      ///< that were compared; 0: none, and nothing is known
  double attitude_rms_deg = 0;  ///< angle between "up" as it is and as the controller has it
  double roll_rms_deg = 0, pitch_rms_deg = 0;  ///< of it, about the body's own axes
  double attitude_worst_deg = 0;
  /// Of all three axes together. Seen along the body's heading: how far that is off is the
  /// odometry's matter.
  double com_velocity_rms_m_s = 0;
  double com_velocity_worst_m_s = 0;
  double dcm_rms_m = 0;  ///< from the sole that carries, along the body's heading
  /// Where the robot has itself at the end, from where and how it stood when the gait began.
  double odometry_off_m = 0;
  double odometry_turned_off_deg = 0;
  double way_m = 0;  ///< the body's, from cycle to cycle, over which that came about
};

class EstimateMeter {
 public:
  /// Once per control tick. `up_world`: against gravity, of length 1.
  void tick(const State& state, const Outputs& outputs, const sim::Truth& truth,
            const sim::Vec3& up_world);
  EstimateErrors result() const;

 private:
  struct Place {  ///< of the body, in a frame of its own
    sim::Vec2 at_m{0, 0};
    double heading_rad = 0;
  };
  void follow(const Place& believed, const Place& real, bool cycle_begins);

  std::uint64_t ticks_ = 0;
  double attitude_rad2_ = 0, roll_rad2_ = 0, pitch_rad2_ = 0, velocity_m2_s2_ = 0, dcm_m2_ = 0;
  double attitude_worst_rad_ = 0, velocity_worst_m_s_ = 0;
  std::optional<Place> believed_first_, real_first_;
  Place believed_, real_;
  sim::Vec2 last_mark_m_{0, 0};
  double way_m_ = 0;
  std::uint8_t stance_ = gait::kBoth;
};

}  // namespace verp::session
