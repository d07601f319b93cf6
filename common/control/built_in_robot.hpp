#pragma once
#include "common/model/params.hpp"

namespace verp::control {

/// A made-up pair of legs, the same in every build: what the boot check walks when it must not
/// trust the robot's own Params. Overwrites all of `params`.
void make_built_in_robot(Params& params);

}  // namespace verp::control
