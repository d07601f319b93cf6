#pragma once
#include <array>
#include <string>
#include <vector>

#include "common/kinematics/leg_ik.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::view {

/// A robot held in the air; joints and links move without physics. Feet use the controller's
/// inverse kinematics; other links damped least squares over the joints to the body.
class PoseHand {
 public:
  PoseHand(const scene::Entity& entity, const Params& params);

  void set_joint(int joint, double angle_rad);
  const std::vector<double>& joint_rad() const { return joint_rad_; }
  void stand();

  /// Moves the sole (0 left, 1 right) as near as the leg reaches and keeps its orientation.
  void move_foot(int side, const scene::Vec3& sole_body_m);
  scene::Vec3 sole_body_m(int side) const;
  /// The node's foot; -1: it is no foot.
  int foot_of(int node) const;
  bool has_leg(int side) const;

  /// Moves as near as the joints reach; does nothing for the body.
  void move_link(int node, const scene::Vec3& point_link_m, const scene::Vec3& to_body_m);
  scene::Vec3 point_body_m(int node, const scene::Vec3& point_link_m) const;
  /// Result of the last move_link() in words; "" before the first since stand().
  const std::string& link_reach() const { return link_reach_; }

  /// Result of the last move in words, such as "within reach".
  std::string reach(int side) const;
  std::string solver(int side) const;

  scene::Snapshot snapshot() const;
  static constexpr double kAir_m = 0.1;  ///< lowest sole above the floor

 private:
  void read_leg(const LegParams& leg, float* leg_rad) const;
  kinematics::LegChain chain(int side) const;
  /// Joints between the body and that link that have their own motors.
  std::vector<std::size_t> joints_to(int node) const;
  /// One step of move_link(); false if nothing moved.
  bool step_to(const std::vector<std::size_t>& joints, int node, const scene::Vec3& point_link_m,
               const scene::Vec3& to_body_m);

  const scene::Entity& entity_;
  const Params& params_;
  std::vector<double> joint_rad_;
  std::array<std::uint8_t, 2> flags_{};
  std::string link_reach_;
};

}  // namespace verp::view
