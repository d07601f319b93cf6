#pragma once
#include <cstddef>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/body.hpp"

/// The gears, belts or rods by which one motor turns two joints: the driver's, and the follower's.
namespace verp::sim {

/// Puts followers where their drivers take them.
void lead(const model::Entity& entity, std::vector<double>& joint_rad);

/// The joint as its servo has it. A follower has no rotor and gears, only its bearing; and of a
/// rotor that has followers the coupling already carries a part (couplings()).
model::Joint joint_at_servo(const model::Entity& entity, std::size_t j, double step_s);

/// A spring and damper between a follower and where its driver takes it, which gives the driver as
/// much back. Each end is a line in its own new speed and takes the other's as it was: ODE has no
/// row for four links. Where both ends speed up together each seems heavier by step * slope, seen
/// from its own side, of which the driver's rotor is relieved; so that must be less than a rotor.
std::vector<Drive> couplings(const model::Entity& entity, const Body& body, double step_s);

}  // namespace verp::sim
