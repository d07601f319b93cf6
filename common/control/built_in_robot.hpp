#pragma once
#include "common/model/params.hpp"

namespace verp::control {

/// An invented pair of legs, the same in every build. The boot check walks it before it trusts the
/// robot's Params. Overwrites all of `params`.
void make_built_in_robot(Params& params);

}  // namespace verp::control
