#pragma once
#include <cstdint>

namespace verp::survey {

struct Interval {
  double low = 0, high = 1;
};

/// Wilson's score interval of a binomial share. It is valid at 0 and at `of`, where the normal
/// approximation is not. `of` = 0 gives 0..1.
Interval interval_of(std::uint64_t good, std::uint64_t of);

}  // namespace verp::survey
