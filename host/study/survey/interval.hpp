#pragma once
#include <cstdint>

namespace verp::survey {

/// Of a share that was counted: where the true one lies, 95 times in 100.
struct Interval {
  double low = 0, high = 1;
};

/// Wilson's score interval of a binomial share, 95 %: `good` of `of`. It stays inside 0..1 and says
/// something at 0 and at all, where the normal approximation says nothing. Of none: all of 0..1.
Interval interval_of(std::uint64_t good, std::uint64_t of);

}  // namespace verp::survey
