#pragma once
#include <string>

#include "common/model/params.hpp"

namespace verp::record {

/// A URDF for viewers: a link `body`, and one per joint with its name, mass and limits, drawn as
/// sticks to its joints.
std::string urdf(const Params& params);

}  // namespace verp::record
