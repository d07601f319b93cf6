#pragma once
#include <string>

#include "common/model/params.hpp"

namespace verp::record {

/// The robot as URDF for viewers: a link `body`, and a link per joint with the joint's name, masses
/// and limits. Each link is drawn as sticks to the joints on it.
std::string urdf(const Params& params);

}  // namespace verp::record
