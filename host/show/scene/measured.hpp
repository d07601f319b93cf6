#pragma once
#include <string>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/show/scene/snapshot.hpp"
#include "host/twin/sim/truth.hpp"

namespace verp::scene {

std::string text_of(const char (&name)[kNameLength]);

std::vector<double> measured_rad(const Inputs& inputs, const Params& params);

/// Adds soles, CoM, support and foot forces, for a view with link poses.
void add_measured(RobotView& view, const Entity& entity, const Params& params,
                  const Inputs& inputs);

/// The feet in the form of the twin's truth.
sim::Truth soles_of(const RobotView& view, const Entity& entity);

}  // namespace verp::scene
