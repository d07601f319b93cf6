#pragma once
#include <array>

#include "common/action/player.hpp"
#include "common/math/linear.hpp"

namespace verp::action {

using Torques = std::array<double, kMaxJoints>;

/// What bears a robot that plays an action, taken to stand level on the soles that carry.
class Support {
 public:
  explicit Support(const Params& params) : params_(params) {}

  /// That the joints hold against weight alone, N m.
  Torques torques(const PlayerOut& now) const;
  /// The centre of mass over one standing sole: x and y in its frame, z above it.
  Vec3 com_over(const PlayerOut& now, int side) const;
  /// How far inside the soles that carry a point of the ground is, in that sole's frame; outside it
  /// is negative.
  double margin_m(const PlayerOut& now, int side, const Vec2& point_m) const;

 private:
  Pose sole(const PlayerOut& now, int side) const;

  const Params& params_;
};

}  // namespace verp::action
