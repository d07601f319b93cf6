#pragma once
#include <string>

#include "common/model/params.hpp"

namespace verp::record {

/// The robot as URDF for viewers: link `body` and one link for each joint, of the joint's name,
/// with masses and limits; each is drawn as sticks to the joints that it carries.
std::string urdf(const Params& params);

}  // namespace verp::record
