#pragma once
#include "common/model/params.hpp"

namespace verp::control {

/// An invented pair of legs, for the boot check before it trusts Params. Overwrites `params`.
void make_built_in_robot(Params& params);

}  // namespace verp::control
