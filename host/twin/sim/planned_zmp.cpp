#include "host/twin/sim/planned_zmp.hpp"

#include <cmath>
#include <numbers>

#include "common/gait/dcm.hpp"
#include "common/math/convert.hpp"

namespace verp::sim {
namespace {

struct Place {
  Vec2 at_m;
  double yaw_rad;
};

Place between(const Place& a, const Place& b) {
  return {(a.at_m + b.at_m) / 2,
          a.yaw_rad + std::remainder(b.yaw_rad - a.yaw_rad, 2 * std::numbers::pi) / 2};
}

Vec2 to_vec(const gait::Xy& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

Place planned(const gait::Foothold& foot) {
  return {to_vec(foot.at_m), static_cast<double>(foot.yaw_rad)};
}

Place actual(const FootTruth& foot) {
  const Vec3 ahead = foot.sole_world.linear().col(0);
  return {foot.sole_world.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

}  // namespace

std::optional<Vec2> planned_zmp_world_m(const Tuning& tuning, const gait::GaitState& gait,
                                        const Truth& truth) {
  if (gait.queued == 0 || !truth.foot[0].present || !truth.foot[1].present) return std::nullopt;
  // Goals run ahead of the robot, which may still be in the previous step.
  std::int32_t time_us = gait.clock_us - math::to_int32(tuning.gait.look_ahead_s * 1e6F);
  const gait::Step& step = time_us < 0 ? gait.previous : gait.queue[0];
  if (time_us < 0) time_us += step.duration_us();

  const auto side = static_cast<std::size_t>(step.carrying());
  const bool one = side != gait::kBoth;
  const Place plan =
      one ? planned(step.foot[side]) : between(planned(step.foot[0]), planned(step.foot[1]));
  const Place real =
      one ? actual(truth.foot[side]) : between(actual(truth.foot[0]), actual(truth.foot[1]));
  const Vec2 zmp_m = to_vec(gait::zmp_at(step, static_cast<float>(time_us) * 1e-6F));
  return real.at_m + Eigen::Rotation2Dd(real.yaw_rad - plan.yaw_rad) * (zmp_m - plan.at_m);
}

}  // namespace verp::sim
