#pragma once
#include <string>
#include <vector>

#include "host/author/import/skeleton.hpp"
#include "host/author/import/wrapper.hpp"

namespace verp::import {

/// Writes into `wrapper` what replaces masses and moments of inertia that no robot has: those in
/// another unit, those of no body, and none where a joint must move some mass. `moving`: bones that
/// stay joints. Returns what a person should know.
std::vector<std::string> mend_masses(const Skeleton& skeleton, const std::vector<int>& moving,
                                     Wrapper& wrapper);

}  // namespace verp::import
