#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

class Goal : public ::testing::TestWithParam<int> {};

// The bar of the paper's walk that is not reached yet, at its full height. tests/run shows the
// outcome in every run.
TEST_P(Goal, MeanZmpBiasIsAtMost12Millimetres) {
  const Walk minute =
      walk("generic21 --step 0.04 --cycle 0.45 --for 60 --seed " + std::to_string(GetParam()));
  expect_walked(minute);
  expect_between(2.0, number(minute, "zmp_bias_mean_mm"), 12.0, "mean ZMP bias, mm");
}
INSTANTIATE_TEST_SUITE_P(Generic21, Goal, ::testing::Range(1, 11));

}  // namespace
}  // namespace verp::scenario
