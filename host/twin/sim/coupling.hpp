#pragma once
#include <cstddef>
#include <vector>

#include "host/robot/model/entity.hpp"
#include "host/twin/sim/body.hpp"

/// Gears, belts or rods: one motor turns two joints, the driver's and the follower's.
namespace verp::sim {

/// Sets followers to the angles that their drivers give them.
void lead(const model::Entity& entity, std::vector<double>& joint_rad);

/// A follower has a bearing but no rotor or gears; at a driver, the coupling carries part of the
/// rotor's inertia.
model::Joint joint_at_servo(const model::Entity& entity, std::size_t j, double step_s);

/// Spring and damper between a follower and its driver. Each end is a line in its own new speed and
/// uses the other's old speed, because ODE has no constraint row for four links. If both ends
/// accelerate together, each seems heavier by step * slope; joint_at_servo() subtracts this from
/// the driver's rotor, so it must be less than a rotor.
std::vector<Drive> couplings(const model::Entity& entity, const Body& body, double step_s);

}  // namespace verp::sim
