#include <gtest/gtest.h>

#include "common/control/self_test.hpp"
#include "common/control/step.hpp"
#include "tests/unit/control/loop.hpp"

namespace verp::control {
namespace {

using test::kRobot;
using test::Loop;
using test::Random;

bool same(const State& a, const State& b) {
  return __builtin_memcmp(&a, &b, sizeof a) == 0;
}

void get_walking(Loop& loop) {
  loop = Loop{};
  loop.walk(1500);
  ASSERT_GE(loop.until(safety::Mode::kWalking, 600), 0);
  loop.ticks(100);
}

TEST(StepDigest, EqualInputsGiveEqualStatesAndDigests) {
  static State a, b;
  a = b = State{};
  Random random(1);
  Inputs inputs;
  Outputs one, other;
  for (int tick = 0; tick < 300; ++tick) {
    test::wild(random, tick % 3 == 0, one, inputs);
    step(kRobot, a, inputs, one);
    step(kRobot, b, inputs, other);
    ASSERT_TRUE(same(a, b)) << "tick " << tick;
    ASSERT_EQ(__builtin_memcmp(&one, &other, sizeof one), 0);
  }
}

TEST(StepDigest, CopyOfAStateContinuesTheSame) {
  Loop& loop = test::fresh_loop();
  static State copy;
  get_walking(loop);
  for (int i = 0; i < 20; ++i) {
    loop.ticks(7);
    copy = loop.state;
    Outputs outputs;
    Inputs inputs = loop.inputs;
    inputs.command = loop.command;
    step(kRobot, copy, inputs, outputs);
    loop.tick();
    ASSERT_TRUE(same(copy, loop.state));
  }
}

TEST(StepDigest, AnyBitOfTheInputsChangesTheDigest) {
  Loop& loop = test::fresh_loop();
  static State before, after;
  get_walking(loop);
  before = loop.state;
  loop.inputs.command = loop.command;
  const Inputs inputs = loop.inputs;
  Outputs outputs;
  after = before;
  step(kRobot, after, inputs, outputs);
  const std::uint64_t chain = after.digest.chain;
  Random random(2);
  for (std::size_t byte = 0; byte < sizeof(Inputs); ++byte) {
    Inputs changed = inputs;
    auto* bytes = reinterpret_cast<unsigned char*>(&changed);
    bytes[byte] = static_cast<unsigned char>(bytes[byte] ^ (1u << random.below(8)));
    after = before;
    step(kRobot, after, changed, outputs);
    EXPECT_NE(after.digest.chain, chain) << "byte " << byte;
  }
}

TEST(StepDigest, ChainRemembersADifference) {
  static Loop a, b;
  a = b = Loop{};
  a.inputs.mailbox = 1;
  a.tick();
  b.tick();
  a.inputs.mailbox = 0;
  for (int i = 0; i < 50; ++i) {
    a.tick();
    b.tick();
    EXPECT_NE(a.state.digest.chain, b.state.digest.chain);
    EXPECT_EQ(a.state.digest.stage[0], b.state.digest.stage[0]) << "nothing else remembers";
  }
}

TEST(StepDigest, AnotherRobotIsSeen) {
  static Params other = kRobot;
  other.leg[0].thigh_m += 1e-6F;
  static State scratch;
  EXPECT_NE(self_test_digest(other, scratch), self_test_digest(kRobot, scratch));
}

TEST(SelfTest, IsRepeatableAndWalks) {
  static State scratch;
  const std::uint64_t once = self_test_digest(kRobot, scratch);
  EXPECT_EQ(self_test_digest(kRobot, scratch), once);
  EXPECT_TRUE(scratch.machine.mode == safety::Mode::kWalking);
}

}  // namespace
}  // namespace verp::control
