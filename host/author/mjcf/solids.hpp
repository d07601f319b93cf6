#pragma once
#include <optional>

#include "host/author/mjcf/mjcf.hpp"

namespace verp::mjcf {

/// Mass and inertia of a body's shapes, as MuJoCo takes them where <inertial> is missing; nothing
/// without mass. The density of a mesh whose file is missing counts as 0.
std::optional<Inertial> inertial_of_geoms(const Body& body, const Robot& robot);

}  // namespace verp::mjcf
