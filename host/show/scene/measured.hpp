#pragma once
#include <string>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/twin/sim/truth.hpp"

/// What a robot's own sensors say of it, where nobody knows the truth.
namespace verp::scene {

/// A name of Params.
std::string text_of(const char (&name)[kNameLength]);

std::vector<double> measured_rad(const Inputs& inputs, const Params& params);

/// Soles, CoM, support and the feet's forces, of a view that has its links' poses.
void add_measured(RobotView& view, const Entity& entity, const Params& params,
                  const Inputs& inputs);

/// The feet of such a view as the twin would tell of them.
sim::Truth soles_of(const RobotView& view, const Entity& entity);

}  // namespace verp::scene
