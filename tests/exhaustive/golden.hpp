#pragma once

namespace verp::exhaustive {

/// Prints tests/unit/math/golden.hpp: what this build computes at the golden arguments.
void print_golden();

}  // namespace verp::exhaustive
