#pragma once

namespace verp::exhaustive {

/// Prints tests/unit/math/golden.hpp: this build's results for the golden arguments.
void print_golden();

}  // namespace verp::exhaustive
