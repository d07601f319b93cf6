#pragma once
#include "host/apps/tool/walk_options.hpp"

namespace verp::tool {

/// The walks of --seeds: this program again for each of them, as many at a time as there are cores,
/// and who survived. A robot that falls is a result. Exit status 1 if somebody interrupted, else
/// that of the first walk that could not be tried.
int walk_seeds(const WalkOptions& options);

}  // namespace verp::tool
