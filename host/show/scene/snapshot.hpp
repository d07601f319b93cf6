#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "host/show/scene/scene.hpp"

namespace verp::scene {

using Vec2 = Eigen::Vector2d;

struct ContactForce {
  int node = 0;
  Vec3 position_world_m = Vec3::Zero();
  Vec3 force_world_n = Vec3::Zero();  ///< on the robot
};

struct Footstep {
  int side = 0;  ///< 0 left, 1 right
  Vec2 at_world_m = Vec2::Zero();
  double yaw_rad = 0;
};

/// Members that the source does not know are empty.
struct RobotView {
  std::vector<Transform> link_world;  ///< one per node
  std::vector<double> joint_rad, goal_rad, torque_use;
  std::vector<ContactForce> contacts;
  std::array<bool, 2> foot_contact{};
  std::array<double, 2> foot_force_n{};
  std::optional<Vec3> com_world_m;
  std::optional<Vec2> zmp_world_m, zmp_planned_world_m;
  std::vector<Vec2> support_world_m;  ///< convex, counter-clockwise
  std::vector<Footstep> footsteps;    ///< the next first
  std::uint32_t faults = 0;           ///< safety::Fault bits
  std::uint8_t mode = 0;              ///< safety::Mode
  std::uint8_t phase = 0;             ///< gait::Phase
  std::uint8_t gait_state = 0;        ///< 0..15
  std::uint8_t stance = 2;            ///< carries: 0 left, 1 right, 2 both
  bool held = false, fallen = false;
  std::array<double, 3> gyro_rad_s{}, accel_m_s2{};  ///< body axes
};

struct Trail {
  Colour colour;
  std::vector<Vec3> points_world_m;
};

/// From a range finder to the hit.
struct Ray {
  Vec3 from_world_m = Vec3::Zero(), to_world_m = Vec3::Zero();
  bool hit = true;
};

struct Snapshot {
  double t_s = 0;  ///< simulated, or the trace's
  std::uint32_t tick = 0;
  std::vector<RobotView> robots;      ///< one per Scene::robots
  std::vector<Transform> body_world;  ///< the world's moving bodies
  std::vector<Trail> trails;          ///< by the display (trails.hpp)
  std::vector<Ray> rays;
};

}  // namespace verp::scene
