#include "tests/scenario/walk.hpp"

namespace verp::scenario {
namespace {

// Robots of other people, through their SDF wrappers alone. They walk, and get somewhere.
void expect_walks(const char* model) {
  const Walk result = walk(std::string(model) + " --for 20");
  expect_walked(result);
  expect_between(1.5, number(result, "ahead_m"), 4.0, "way ahead, m");
}

TEST(ThirdParty, Op3Walks) {
  expect_walks("op3");
}
TEST(ThirdParty, DarwinOpWalks) {
  expect_walks("darwin_op");
}

}  // namespace
}  // namespace verp::scenario
