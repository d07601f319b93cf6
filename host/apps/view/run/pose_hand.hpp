#pragma once
#include <array>
#include <string>
#include <vector>

#include "common/kinematics/leg_ik.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::view {

/// A robot in the air, held by its body, whose joints, feet and other links a hand moves:
/// kinematics, no physics. Feet go by the controller's own inverse kinematics, all other links by
/// damped least squares of the joints between them and the body.
class PoseHand {
 public:
  PoseHand(const scene::Entity& entity, const Params& params);

  void set_joint(int joint, double angle_rad);
  const std::vector<double>& joint_rad() const { return joint_rad_; }
  void stand();

  /// 0 left, 1 right: the sole goes there, as near as the leg reaches, turned as it is.
  void move_foot(int side, const scene::Vec3& sole_body_m);
  scene::Vec3 sole_body_m(int side) const;
  /// Whether that node is part of that foot: -1 of neither.
  int foot_of(int node) const;
  bool has_leg(int side) const;

  /// That point of a link goes there, as near as its joints reach; of the body itself nothing does.
  void move_link(int node, const scene::Vec3& point_link_m, const scene::Vec3& to_body_m);
  scene::Vec3 point_body_m(int node, const scene::Vec3& point_link_m) const;
  /// What the last move_link() had to give up, in words; "" if there was none since stand().
  const std::string& link_reach() const { return link_reach_; }

  /// What the last move had to give up, in words; "within reach" of one that gave up nothing.
  std::string reach(int side) const;
  std::string solver(int side) const;

  scene::Snapshot snapshot() const;
  static constexpr double kAir_m = 0.1;  ///< of the lowest sole above the floor, standing

 private:
  kinematics::LegChain chain(int side) const;
  /// The joints between the body and that link which have motors of their own.
  std::vector<std::size_t> joints_to(int node) const;
  /// One step of move_link(): false if nothing moved any more.
  bool step_to(const std::vector<std::size_t>& joints, int node, const scene::Vec3& point_link_m,
               const scene::Vec3& to_body_m);

  const scene::Entity& entity_;
  const Params& params_;
  std::vector<double> joint_rad_;
  std::array<std::uint8_t, 2> flags_{};
  std::string link_reach_;
};

}  // namespace verp::view
