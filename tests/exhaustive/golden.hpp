#pragma once

namespace verp::exhaustive {

/// Prints tests/unit/math/golden.hpp.
void print_golden();

}  // namespace verp::exhaustive
