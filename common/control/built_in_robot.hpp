#pragma once
#include "common/model/params.hpp"

namespace verp::control {

/// Invented legs, for the boot check before it trusts Params.
void make_built_in_robot(Params& params);

}  // namespace verp::control
