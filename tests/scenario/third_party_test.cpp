#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// Robots of other people, through their SDF wrappers alone. They walk, and get somewhere.
void expect_walks(const char* model) {
  const Walk result = walk(std::string(model) + " --for 20");
  expect_walked(result);
  EXPECT_GT(number(result, "distance_m"), 1.5);
}

TEST(ThirdParty, Op3Walks) {
  expect_walks("op3");
}
TEST(ThirdParty, DarwinOpWalks) {
  expect_walks("darwin_op");
}

}  // namespace
}  // namespace verp::scenario
