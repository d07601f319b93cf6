#pragma once
#include <array>
#include <string>
#include <vector>

#include "common/kinematics/leg_ik.hpp"
#include "host/scene/snapshot.hpp"

namespace verp::view {

/// A robot in the air, held by its body, whose joints and feet a hand moves: kinematics, no
/// physics. Feet go by the controller's own inverse kinematics.
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

  /// What the last move had to give up, in words; "within reach" of one that gave up nothing.
  std::string reach(int side) const;
  std::string solver(int side) const;

  scene::Snapshot snapshot() const;
  static constexpr double kAir_m = 0.1;  ///< of the lowest sole above the floor, standing

 private:
  kinematics::LegChain chain(int side) const;

  const scene::Entity& entity_;
  const Params& params_;
  std::vector<double> joint_rad_;
  std::array<std::uint8_t, 2> flags_{};
};

}  // namespace verp::view
