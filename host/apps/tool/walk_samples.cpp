#include "host/apps/tool/walk_samples.hpp"

#include <cmath>

#include "host/robot/model/principal.hpp"

namespace verp::tool {
namespace {

using model::Mat3;
using model::Vec3;

/// Params gives the sole as the foot sees it.
Vec3 ankle_in_sole(const LegParams& leg) {
  Mat3 foot_sole;
  for (int i = 0; i < 9; ++i) foot_sole(i / 3, i % 3) = static_cast<double>(leg.sole_foot[i]);
  const Xyz& at = leg.sole_foot_m;
  return foot_sole.transpose() *
         -Vec3(static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z));
}

report::Point3 point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

void add_foot(const LegParams& leg, const sim::SeriesRow& row, std::size_t side,
              report::Sample& sample) {
  constexpr double kContact_n = sim::kContactForceN;
  const Mat3 rotation = model::rotation_rpy(row.sole_rpy_rad[side]);
  const Vec3& sole = row.sole_world_m[side];
  sample.ankle[side] = point(sole + rotation * ankle_in_sole(leg));
  const double front = static_cast<double>(leg.sole_front_m),
               back = -static_cast<double>(leg.sole_back_m);
  const double left = static_cast<double>(leg.sole_left_m),
               right = -static_cast<double>(leg.sole_right_m);
  const Vec3 corners[4] = {{front, left, 0}, {front, right, 0}, {back, right, 0}, {back, left, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 corner = sole + rotation * corners[i];
    sample.sole[side][i] = {corner.x(), corner.y()};
  }
  sample.contact[side] = row.foot_force_n[side] > kContact_n;
}

}  // namespace

report::Sample to_sample(const Params& params, const sim::SeriesRow& row, double start_s) {
  report::Sample sample;
  sample.t_s = row.t_s - start_s;
  sample.phase = row.phase;
  sample.state = row.state;
  sample.carrying = row.stance;
  sample.body = point(row.body_world_m);
  sample.roll_pitch_yaw_rad = {row.body_rpy_rad.x(), row.body_rpy_rad.y(), row.body_rpy_rad.z()};
  for (std::size_t side = 0; side < 2; ++side) add_foot(params.leg[side], row, side, sample);
  if (row.zmp_valid) sample.zmp = report::Point2{row.zmp_world_m.x(), row.zmp_world_m.y()};
  if (row.zmp_planned_valid) {
    sample.zmp_planned = report::Point2{row.zmp_planned_world_m.x(), row.zmp_planned_world_m.y()};
  }
  if (row.zmp_valid && row.stance < 2) {
    const auto& sole = sample.sole[row.stance];
    const double x_m = (sole[0].x_m + sole[2].x_m) / 2, y_m = (sole[0].y_m + sole[2].y_m) / 2;
    sample.zmp_bias_mm = 1000 * std::hypot(sample.zmp->x_m - x_m, sample.zmp->y_m - y_m);
  }
  sample.joint_rad = row.joint_rad;
  sample.goal_rad = row.goal_rad;
  sample.torque_use = row.torque_use;
  return sample;
}

}  // namespace verp::tool
