#include "host/study/survey/interval.hpp"

#include <gtest/gtest.h>

namespace verp::survey {
namespace {

// Newcombe, Statistics in Medicine 17 (1998), table I, method 3; z^2 / (n + z^2) at the ends.
TEST(Interval, IsWilsonsOfPublishedShares) {
  const struct {
    std::uint64_t good, of;
    double low, high;
  } kRows[] = {
      {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0, 0.1611},
      {1, 29, 0.0061, 0.1718},   {100, 100, 0.9630, 1},     {0, 0, 0, 1},
  };
  for (const auto& row : kRows) {
    const Interval found = interval_of(row.good, row.of);
    EXPECT_NEAR(found.low, row.low, 5e-5) << row.good << " of " << row.of;
    EXPECT_NEAR(found.high, row.high, 5e-5) << row.good << " of " << row.of;
  }
}

}  // namespace
}  // namespace verp::survey
