#include "tests/replay/long_trace.hpp"

#include "common/control/step.hpp"
#include "tests/replay/campaign.hpp"
#include "tests/replay/echo_plant.hpp"
#include "tests/replay/robots.hpp"

namespace verp::replay {
namespace {

/// Random bits in every field but the tick, or one damaged word. `nth` counts the run's ticks.
void damage(std::uint32_t nth, test::SmallRandom& random, Inputs& in) {
  constexpr std::uint32_t kTurn = 200;
  std::uint32_t words[sizeof(Inputs) / 4];
  __builtin_memcpy(words, &in, sizeof in);
  if (nth / kTurn % 4 == 3) {
    for (std::uint32_t& word : words) word = random.bits();
  } else if (random.bits() % 8 == 0) {
    words[random.bits() % std::size(words)] = random.bits();
  }
  const std::uint32_t tick = in.tick;
  __builtin_memcpy(static_cast<void*>(&in), words, sizeof in);
  in.tick = tick;
}

/// One. A damaged clock gives several, zero or any number.
std::uint32_t periods(bool damaged, test::SmallRandom& random) {
  if (!damaged || random.bits() % 256 != 0) return 1;
  const std::uint32_t bits = random.bits();
  return bits % 4 == 0 ? random.bits() : bits % 4 == 1 ? 0 : bits / 4 % 16;
}

Segment run(const Robot& robot, std::uint32_t ticks) {
  Segment segment{robot.name, robot.params, {}};
  segment.ticks.reserve(ticks);
  test::SmallRandom random(robot.seed);
  Campaign campaign(segment.params, robot.seed);
  EchoPlant plant(segment.params, robot.seed + 1);
  State state;
  Outputs outputs;
  std::uint32_t tick = 0;
  for (std::uint32_t nth = 0; nth < ticks; ++nth) {
    Inputs inputs;
    inputs.tick = tick;
    const std::uint32_t events = campaign.advance(outputs, inputs);
    plant.sense(outputs, events, inputs);
    if (robot.damaged) damage(nth, random, inputs);
    tick += periods(robot.damaged, random);
    step(segment.params, state, inputs, outputs);
    segment.ticks.push_back({state.digest, inputs});
  }
  return segment;
}

}  // namespace

std::vector<Segment> make_long_trace(const Params& robot, std::uint32_t ticks) {
  std::vector<Segment> trace;
  for (const Robot& each : make_robots(robot)) {
    trace.push_back(run(each, ticks / 100 * each.percent));
  }
  return trace;
}

}  // namespace verp::replay
