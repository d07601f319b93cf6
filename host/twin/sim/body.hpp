#pragma once
#include <deque>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/servo.hpp"
#include "host/twin/sim/world.hpp"

/// Joint j moves node j + 1; node 0 is the body.
namespace verp::sim {

std::vector<Transform> link_poses(const model::Entity& entity, const Transform& body_world,
                                  const std::vector<double>& joint_rad);

/// Soles level (their mean), their midpoint over start_m, mean heading along yaw, lowest point
/// gap_m above the ground. Without legs: body level, over start_m.
Transform standing_pose(const model::Entity& entity, const std::vector<double>& joint_rad,
                        const Vec3& start_m, double yaw_rad, double gap_m);

/// Moves a pose vertically until the lowest point is gap_m above the ground.
Transform resting(const model::Entity& entity, const std::vector<double>& joint_rad,
                  Transform body_world, double gap_m);

/// Leg 0 left, 1 right; or null.
const model::Limb* find_leg(const model::Entity& entity, int foot);

/// Load on the joint's child link in the last step, about `point_world_m`.
struct JointLoad {
  Vec3 point_world_m = Vec3::Zero();
  Vec3 force_world_n = Vec3::Zero(), torque_world_n_m = Vec3::Zero();
};

class Body {
 public:
  /// mass_factor scales each node's mass and inertia. Throws std::invalid_argument if a link has no
  /// mass.
  Body(World& world, const model::Entity& entity, const std::vector<double>& mass_factor,
       int owner);
  ~Body();
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  /// At rest.
  void place(const Transform& body_world, const std::vector<double>& joint_rad);
  /// Call after every step.
  void read_joints();
  void drive(int joint, const Drive& drive);
  /// load() reports this joint from the next step on.
  void meter(int joint);
  JointLoad load(int joint) const;
  /// Inertia of each joint in the present pose: its link and all beyond, about its axis.
  std::vector<double> inertias_kg_m2() const;
  /// Changes the mass and scales the inertia; the shape stays.
  void set_mass(int node, double mass_kg);
  /// About the link's x, y or z. Throws std::invalid_argument unless it stays positive definite.
  void set_inertia(int node, int axis, double inertia_kg_m2);
  /// Moves the whole robot; its velocities stay.
  void move(const Transform& by_world);
  /// Adds a rigid velocity to the whole robot; the rotation is about the body's origin.
  void add_velocity(const Vec3& linear_world_m_s, const Vec3& angular_world_rad_s);
  dBodyID ode_body(int node) const { return links_[static_cast<std::size_t>(node)].body; }
  std::vector<GeomTag*> tags(int node) const;
  /// Fixes the body to the world, like a robot stand.
  void hold();
  void release();
  bool held() const { return hold_ != nullptr; }

  /// Counts turns: no jump at half a revolution.
  double angle_rad(int joint) const { return angle_rad_[static_cast<std::size_t>(joint)]; }
  double rate_rad_s(int joint) const { return rate_rad_s_[static_cast<std::size_t>(joint)]; }
  const std::vector<double>& angles_rad() const { return angle_rad_; }
  const std::vector<double>& rates_rad_s() const { return rate_rad_s_; }

  Transform link_pose(int node) const;
  std::vector<Transform> links_world() const;  ///< of each node
  Vec3 angular_velocity_world_rad_s(int node) const;
  Vec3 point_velocity_world_m_s(int node, const Vec3& point_world_m) const;
  double mass_kg() const { return mass_kg_; }
  double mass_kg(int node) const { return links_[static_cast<std::size_t>(node)].mass_kg; }
  const Mat3& inertia_kg_m2(int node) const {
    return links_[static_cast<std::size_t>(node)].inertia_kg_m2;
  }
  Vec3 com_world_m() const;
  Vec3 com_velocity_world_m_s() const;

 private:
  struct Link {
    dBodyID body = nullptr;
    Vec3 com_m = Vec3::Zero();  ///< origin of ODE's body frame, parallel to the link frame
    double mass_kg = 0;
    Mat3 inertia_kg_m2 = Mat3::Zero();  ///< about the centre of mass, link axes
  };
  void make_link(const model::Node& node, double mass_factor, int index, int owner);
  void weigh(const Link& link) const;
  void make_hinge(const model::Joint& joint, int index, const std::vector<Transform>& zero_pose);

  World& world_;
  const model::Entity& entity_;
  const std::vector<std::size_t> outward_;  ///< joints, parents first
  std::vector<Link> links_;
  std::vector<dJointID> hinges_;
  std::vector<dGeomID> geoms_;
  std::deque<dJointFeedback> feedback_;  ///< a deque: ODE points to these
  dJointID hold_ = nullptr;
  double mass_kg_ = 0;
  std::vector<double> angle_rad_;
  std::vector<double> rate_rad_s_;
};

}  // namespace verp::sim
