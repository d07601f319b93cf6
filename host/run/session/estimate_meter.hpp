#pragma once
#include <cstdint>
#include <optional>

#include "common/control/state.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::session {

/// Errors over the gait up to a fall: root mean squares and maxima.
struct EstimateErrors {
  std::uint64_t ticks = 0;                     ///< 0: no result
  double attitude_rms_deg = 0;                 ///< between true and estimated "up"
  double roll_rms_deg = 0, pitch_rms_deg = 0;  ///< about the body's axes
  double attitude_worst_deg = 0;
  /// Norm over three axes in the body's heading; odometry covers the heading's error.
  double com_velocity_rms_m_s = 0;
  double com_velocity_worst_m_s = 0;
  double dcm_rms_m = 0;  ///< from the supporting sole, along the heading
  /// End pose relative to the gait's start.
  double odometry_off_m = 0;
  double odometry_turned_off_deg = 0;
  double way_m = 0;  ///< from cycle to cycle
};

class EstimateMeter {
 public:
  /// Call once per control tick. `up_world`: unit vector against gravity.
  void tick(const State& state, const Outputs& outputs, const sim::Truth& truth,
            const sim::Vec3& up_world);
  EstimateErrors result() const;

 private:
  struct Place {  ///< of the body
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
