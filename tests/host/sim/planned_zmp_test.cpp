#include "host/twin/sim/planned_zmp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/math/convert.hpp"
#include "tests/unit/gait/walker.hpp"

namespace verp::sim {
namespace {

using gait::kBoth;
using gait::test::Walker;

constexpr gait::VelocityIn kOrders[] = {{.vx_m_s = 0.1777F},
                                        {.vx_m_s = -0.1F},
                                        {.vx_m_s = 0.05F, .vy_m_s = 0.05F},
                                        {.wz_rad_s = 0.5F},
                                        {.stop = true}};
constexpr int kTicksPerOrder = 300;

FootTruth sole_at(double x_m, double y_m, double z_m, double yaw_rad) {
  FootTruth foot;
  foot.present = true;
  foot.sole_world.linear() = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
  foot.sole_world.translation() = Vec3(x_m, y_m, z_m);
  return foot;
}

Truth as_planned(const Walker& walker) {
  const auto look_ahead_us = math::to_int32(1e6F * walker.tuning.gait.look_ahead_s);
  const gait::Posture posture =
      posture_before(*walker.params, walker.tuning, walker.state, look_ahead_us);
  Truth truth;
  for (int side = 0; side < 2; ++side) {
    const Pose sole = gait::sole_in_body(posture, side);
    FootTruth& foot = truth.foot[static_cast<std::size_t>(side)];
    foot.present = true;
    foot.sole_world.linear() = (posture.body.rotation * sole.rotation).cast<double>();
    foot.sole_world.translation() =
        (posture.body.position_m + posture.body.rotation * sole.position_m).cast<double>();
  }
  return truth;
}

std::vector<Vec2> support_polygon(const Params& params, const Truth& truth) {
  std::vector<Vec2> corners;
  for (std::size_t side = 0; side < 2; ++side) {
    const LegParams& leg = params.leg[side];
    for (const float x : {leg.sole_front_m, -leg.sole_back_m}) {
      for (const float y : {leg.sole_left_m, -leg.sole_right_m}) {
        const Vec3 corner(static_cast<double>(x), static_cast<double>(y), 0);
        corners.push_back((truth.foot[side].sole_world * corner).head<2>());
      }
    }
  }
  return convex_hull(std::move(corners));
}

bool inside(const std::vector<Vec2>& hull, const Vec2& point) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i], to = point - hull[i];
    if (edge.x() * to.y() - edge.y() * to.x() < -1e-6) return false;
  }
  return true;
}

TEST(PlannedZmp, LiesUnderTheFootThatCarriesAlone) {
  Walker walker(verp::test::kRobot);
  walker.set_off({});
  int seen[2] = {};
  for (int i = 0; i < kTicksPerOrder * 5; ++i) {
    walker.in.wanted = kOrders[i / kTicksPerOrder];
    walker.tick();
    if (walker.out.swing == kBoth) continue;
    const int side = 1 - walker.out.swing;
    ++seen[side];
    constexpr double kX = 2.0, kY = -1.0, kYaw = 0.7;  // of the carrying foot
    Truth truth;
    truth.foot = {sole_at(0, 0, 0.02, 0), sole_at(0, 0, 0.02, 0)};
    truth.foot[static_cast<std::size_t>(side)] = sole_at(kX, kY, 0, kYaw);
    const auto zmp_m = planned_zmp_world_m(walker.tuning, walker.state, truth);
    ASSERT_TRUE(zmp_m.has_value());

    const Vec2 in_sole_m = Eigen::Rotation2Dd(-kYaw) * (*zmp_m - Vec2(kX, kY));
    const LegParams& leg = walker.params->leg[side];
    ASSERT_LT(in_sole_m.x(), static_cast<double>(leg.sole_front_m)) << "tick " << i;
    ASSERT_GT(in_sole_m.x(), static_cast<double>(-leg.sole_back_m)) << "tick " << i;
    ASSERT_LT(in_sole_m.y(), static_cast<double>(leg.sole_left_m)) << "tick " << i;
    ASSERT_GT(in_sole_m.y(), static_cast<double>(-leg.sole_right_m)) << "tick " << i;
    const gait::Xy wanted = gait::zmp_under(*walker.params, walker.tuning.gait, side, {});
    const Vec2 wanted_m(static_cast<double>(wanted.x), static_cast<double>(wanted.y));
    ASSERT_LT((in_sole_m - wanted_m).norm(), 0.002) << "tick " << i;
  }
  EXPECT_GT(seen[0], 300);
  EXPECT_GT(seen[1], 300);
}

TEST(PlannedZmp, StaysInTheSupportPolygonOfARobotThatStandsAsPlanned) {
  Walker walker(verp::test::kRobot);
  walker.set_off({});
  int seen = 0;
  for (int i = 0; i < kTicksPerOrder * 5; ++i) {
    walker.in.wanted = kOrders[i / kTicksPerOrder];
    walker.in.walk = !walker.in.wanted.stop;
    walker.tick();
    const Truth truth = as_planned(walker);
    const auto zmp_m = planned_zmp_world_m(walker.tuning, walker.state, truth);
    if (!zmp_m) continue;
    ++seen;
    ASSERT_TRUE(inside(support_polygon(*walker.params, truth), *zmp_m)) << "tick " << i;
  }
  EXPECT_GT(seen, kTicksPerOrder * 4);
}

TEST(PlannedZmp, IsNowhereWhileTheRobotStandsOrHasNoFeet) {
  Walker walker(verp::test::kRobot);
  Truth truth;
  truth.foot = {sole_at(0, 0.04, 0, 0), sole_at(0, -0.04, 0, 0)};
  walker.run(0.5F);
  EXPECT_FALSE(planned_zmp_world_m(walker.tuning, walker.state, truth).has_value());
  walker.set_off({});
  walker.run(1.0F);
  EXPECT_TRUE(planned_zmp_world_m(walker.tuning, walker.state, truth).has_value());
  EXPECT_FALSE(planned_zmp_world_m(walker.tuning, walker.state, Truth{}).has_value());
}

}  // namespace
}  // namespace verp::sim
