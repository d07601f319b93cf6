#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "common/control/step.hpp"
#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "host/run/session/session.hpp"
#include "host/twin/sim/random.hpp"
#include "tests/hil/safe_table.hpp"

// Goals stay inside limits, modes and torque inside the safe table. VERP_SEED=7 runs that seed
// alone.
namespace verp::test {
namespace {

constexpr int kLongest_s = 10, kLimpTicks = 5;  // the torque-off goal may be late

struct Lying {
  Lying() : entity(model::load_robot(model::find_model("generic21"), "")) {
    params = model::make_params(entity);
    made = action::make_library(params, action::read_folder(action::folder_of(entity.file)));
  }
  model::Entity entity;
  Params params;
  action::CompiledActions made;
};

enum class Trouble {
  kNone,
  kServoSilent,
  kImuSilent,
  kImuFrozen,
  kImuWrong,
  kOperatorQuiet,
  kEmergency,
  kHot,
  kLowVoltage,
  kBent,
  kLate,
  kCount
};

class Troubled {
 public:
  explicit Troubled(std::uint64_t seed)
      : random_(seed, 77), what_(static_cast<Trouble>(seed % static_cast<int>(Trouble::kCount))) {
    from_ = whole(0, 1200);
    for_ = whole(3, 400);
    joint_ = whole(0, 20);
  }
  void spoil(Inputs& inputs) {
    inputs.tick += late_;
    const std::uint32_t at = nth_++;
    if (at < from_ || at >= from_ + for_) return;
    const auto without = [&](std::uint16_t flag) {
      inputs.flags = static_cast<std::uint16_t>(inputs.flags & ~flag);
    };
    if (what_ == Trouble::kServoSilent) inputs.fresh &= ~(1U << joint_);
    if (what_ == Trouble::kImuSilent) without(kImuFresh);
    if (what_ == Trouble::kOperatorQuiet) without(kCommandFresh);
    if (what_ == Trouble::kEmergency) inputs.flags |= kEmergencyStop;
    if (what_ == Trouble::kHot) inputs.slow_temperature_c = 90;
    if (what_ == Trouble::kLowVoltage) inputs.slow_voltage_tenth_v = 80;
    if (what_ == Trouble::kBent) inputs.position_count[joint_] += 3000;
    if (what_ == Trouble::kLate && at % 8 == 0) late_ += joint_, inputs.tick += joint_;
    for (int axis = 0; axis < 3; ++axis) {
      if (what_ == Trouble::kImuWrong) inputs.accel_count[axis] = random_count();
      if (what_ == Trouble::kImuFrozen) inputs.gyro_count[axis] = inputs.accel_count[axis] = 100;
    }
  }

 private:
  std::uint32_t whole(int low, int high) {
    return static_cast<std::uint32_t>(low + (high - low) * 0.5 * (1 + random_.uniform(-1, 1)));
  }
  std::int16_t random_count() { return static_cast<std::int16_t>(8000 * random_.uniform(-1, 1)); }

  sim::Random random_;
  Trouble what_;
  std::uint32_t from_ = 0, for_ = 0, joint_ = 0, nth_ = 0, late_ = 0;
};

struct Ended {
  std::string violation;
  std::uint32_t seen = 0;
};

Ended run(const Lying& robot, std::uint64_t seed) {
  session::WalkPlan plan;
  plan.entity = robot.entity;
  plan.params = robot.params;
  plan.velocity.vx_tenth_mm_s = 1000;
  plan.actions = robot.made.words;
  plan.get_ups = 3;
  plan.walk_s = 3;
  plan.twin.seed = seed;
  plan.twin.lies = sim::Lies::kAny;
  Troubled troubled(seed);
  SafeTable table(plan.params);
  session::Hooks hooks;
  Ended ended;
  int limp_ticks = 0;
  session::Session* whole = nullptr;
  hooks.decide = [&](const Params& params, State& state, const Inputs& told, Outputs& outputs) {
    Inputs inputs = told;
    troubled.spoil(inputs);
    step(params, robot.made.library(), state, inputs, outputs);
    table.tick(inputs, outputs);
    limp_ticks = outputs.torque_enable == 0 ? limp_ticks + 1 : 0;
  };
  hooks.ticked = [&](const session::Tick&) {
    for (int j = 0; j < plan.params.joint_count && limp_ticks > kLimpTicks; ++j) {
      if (whole->robot(0).twin().setpoint(j).torque_on && ended.violation.empty()) {
        ended.violation = "servo " + std::to_string(j) + " of a limp robot has torque";
      }
    }
  };
  session::Options options;
  options.world.step_us = 2000;
  session::Session session(options);
  whole = &session;
  session.add(plan, hooks);
  while (session.now_us() < 1'000'000U * kLongest_s && session.tick() != nullptr) {
  }
  if (ended.violation.empty()) ended.violation = table.violation();
  ended.seen = table.seen();
  return ended;
}

std::uint32_t run_seeds(std::uint64_t first, std::uint64_t last) {
  const Lying robot;
  const char* const only = std::getenv("VERP_SEED");
  std::uint32_t seen = 0;
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    if (only != nullptr && std::to_string(seed) != only) continue;
    const Ended ended = run(robot, seed);
    EXPECT_EQ(ended.violation, "") << "VERP_SEED=" << seed;
    seen |= ended.seen;
  }
  return seen;
}

constexpr std::uint32_t bit(safety::Mode mode) {
  return 1U << static_cast<unsigned>(mode);
}

TEST(Floor, AnyPoseAndTroubleKeepsTheSafeTable) {
  const std::uint32_t seen = run_seeds(1, 11);
  EXPECT_NE(seen & bit(safety::Mode::kGettingUp), 0U) << "none was ever asked to get up";
  EXPECT_NE(seen & bit(safety::Mode::kHolding), 0U) << "the trouble is none";
}

TEST(ThousandOnTheFloor, AnyPoseAndTroubleKeepsTheSafeTable) {
  run_seeds(1, 1000);
}

}  // namespace
}  // namespace verp::test
