#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "host/twin/sim/world.hpp"

/// The true state, for scoring and pictures; the controller never sees it.
namespace verp::sim {

using Vec2 = Eigen::Vector2d;

struct FootTruth {
  bool present = false;
  bool contact = false;  ///< carries more than kContactForceN
  double normal_force_n = 0;
  Transform sole_world = Transform::Identity();
  std::array<Vec3, 4> corner_world_m{};  ///< front-left, front-right, back-right, back-left
  Vec3 centroid_world_m = Vec3::Zero();  ///< of the sole
};

struct Truth {
  double t_s = 0;
  Transform body_world = Transform::Identity();
  Vec3 body_velocity_world_m_s = Vec3::Zero();
  Vec3 body_rate_world_rad_s = Vec3::Zero();
  double roll_rad = 0, pitch_rad = 0, yaw_rad = 0;  ///< body: Rz(yaw) Ry(pitch) Rx(roll)
  Vec3 com_world_m = Vec3::Zero();
  Vec3 com_velocity_world_m_s = Vec3::Zero();
  bool zmp_valid = false;             ///< the feet carry load
  Vec2 zmp_world_m = Vec2::Zero();    ///< on z = 0, last step
  std::array<FootTruth, 2> foot;      ///< left, right
  std::vector<Vec2> support_world_m;  ///< convex, counter-clockwise
  std::vector<double> joint_rad;
  std::vector<double> joint_rad_s;
  std::vector<double> torque_n_m;  ///< motor, gearbox, end stop; joint sense
  std::vector<double> torque_use;  ///< share of stall torque
  bool held = false;
  bool fallen = false;  ///< latched
};

inline constexpr double kContactForceN = 1.0;

/// Summed over physics steps: their mean and the mean ZMP.
class FootLoads {
 public:
  void add(const Vec3& position_world_m, const Vec3& force_world_n);
  void add(const FootLoads& other);
  bool valid() const { return force_n_ > kContactForceN; }
  /// The ZMP on z = 0. Call only if valid().
  Vec2 zmp_world_m() const { return moment_n_m_ / force_n_; }
  double force_n() const { return force_n_; }

 private:
  double force_n_ = 0;  ///< vertical
  Vec2 moment_n_m_ = Vec2::Zero();
};

/// Counter-clockwise convex hull without collinear points.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// (roll, pitch, yaw) of Rz(yaw) Ry(pitch) Rx(roll).
Vec3 roll_pitch_yaw(const Mat3& rotation);

}  // namespace verp::sim
