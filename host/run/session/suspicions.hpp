#pragma once
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::session {

/// Mistakes of a builder that show although the robot walks: an IMU askew on its bracket, an
/// accelerometer that counts in g.
class Suspicions {
 public:
  /// Call once per tick.
  void tick(const Params& params, const Inputs& inputs, const State& state);
  /// In words; empty: none. `level`: the floor is.
  std::string text(double gravity_m_s2, bool level) const;

 private:
  float gravity_m_s2_ = 0;              ///< mean of the accelerometer; 0: not heard
  float roll_rad_ = 0, pitch_rad_ = 0;  ///< of both soles, by IMU and encoders
};

}  // namespace verp::session
