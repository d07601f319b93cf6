#pragma once
#include <array>

#include "common/action/player.hpp"
#include "common/math/linear.hpp"

namespace verp::action {

using Torques = std::array<double, kMaxJoints>;

/// Carrying soles stand level.
class Support {
 public:
  explicit Support(const Params& params) : params_(params) {}

  /// Torques against weight alone, N m.
  Torques torques(const PlayerOut& now) const;
  /// The centre of mass relative to a standing sole: x and y in its frame, z above.
  Vec3 com_over(const PlayerOut& now, int side) const;
  /// Distance inside the carrying soles of a point in that sole's frame; negative outside.
  double margin_m(const PlayerOut& now, int side, const Vec2& point_m) const;

 private:
  Pose sole(const PlayerOut& now, int side) const;

  const Params& params_;
};

}  // namespace verp::action
