#include <cstdio>

#include "common/control/step.hpp"
#include "tests/replay/divergence.hpp"
#include "tests/replay/trace_file.hpp"
#include "tests/unit/control/falling_loop.hpp"

/// replay_reach FILE: counts how often FILE's inputs reach each line, branch, gait phase, mode,
/// safety row and fault. Exit status 1 if a phase, mode, row or fault is not reached, or if a
/// digest differs.
///
/// --wrap of safety::next_mode makes the rows visible.
namespace verp::replay {
namespace {

std::size_t row_count[32], mode_count[safety::kModes], phase_count[4], fault_count[32];

void note_row(safety::Mode mode, std::uint32_t conditions) {
  const auto from = std::uint32_t{1} << static_cast<unsigned>(mode);
  for (int i = 0; i < safety::kRows; ++i) {
    const safety::Row& row = safety::kTable[i];
    if ((row.from & from) == 0 || (conditions & row.all_of) != row.all_of) continue;
    if ((conditions & row.none_of) != 0) continue;
    ++row_count[i];
    return;
  }
}

void count(const Outputs& outputs) {
  ++mode_count[outputs.mode];
  ++phase_count[outputs.gait_phase];
  for (int i = 0; i < 32; ++i) fault_count[i] += outputs.faults >> i & 1U;
}

bool run(const Segment& segment) {
  State state;
  Outputs outputs;
  bool good = true;
  for (const TickRecord& tick : segment.ticks) {
    step(segment.params, state, tick.inputs, outputs);
    count(outputs);
    if (good && !same(tick.digest, state.digest)) {
      complain(segment, tick, state.digest);
      good = false;
    }
  }
  return good;
}

// The trace has no actions, so a standing robot plays these: a repeat, a way out, each condition, a
// half-stiff joint.
void act() {
  action::test::Shelf shelf;
  for (int i = 0; i < 3; ++i) {
    shelf.goal(i, test::kLeftArm, 0.3F * static_cast<float>(i));
    shelf.frame[i].stiffness_percent[test::kLeftArm] = 50;
  }
  shelf.frame[1].smooth = 0;
  shelf.frame[1].loop_to = 0;
  shelf.frame[1].loops = 1;
  shelf.frame[0].exit = 1;
  shelf.frame[0].stance = action::Stance::kLeft;
  shelf.frame[1].stance = action::Stance::kRight;
  for (int condition = 0; condition < action::kConditions; ++condition) {
    shelf.frame[2].condition = static_cast<action::Condition>(condition);
    shelf.frame[2].wait_ms = 30;
    shelf.seal();
    control::test::Loop loop;
    loop.actions = shelf.library();
    loop.command.request = Request::kStand;
    for (int tick = 0; tick < 2000; ++tick) {
      loop.tick();
      count(loop.outputs);
      const bool ready = tick == 1000 || tick == 1300;
      if (ready) loop.inputs.action = static_cast<std::uint8_t>(tick == 1000 ? 2 : 1);
      if (tick == 1310 && condition % 2 == 0) loop.inputs.action = 0;
    }
  }
}

void follow(control::test::Loop& loop, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    loop.tick();
    count(loop.outputs);
  }
}

// Toppled, it gets up on request (first in vain); knocked, it holds and rises. Then robots lie on
// each side, with and without an action for it.
void fall() {
  using control::test::FallingLoop;
  constexpr std::int16_t kOne = 8172, kKnock = 2830;
  FallingLoop loop;
  follow(loop, 300);
  --loop.inputs.tick;  // one tick twice
  follow(loop, 1);
  loop.topple(safety::Mode::kFalling);
  count(loop.outputs);
  loop.command.request = Request::kGetUp;
  follow(loop, 600);
  loop.hold_up(0, kOne);
  follow(loop, 1000);
  loop.inputs.gyro_count[1] = kKnock;
  follow(loop, 20);
  loop.inputs.gyro_count[1] = -kKnock;
  follow(loop, 8);
  loop.inputs.gyro_count[1] = 0;
  follow(loop, 300);
  action::test::Shelf shelf = control::test::falling_shelf();
  for (const auto& name : {action::kGetUpLeft, action::kGetUpRight, action::kGetUpBack}) {
    __builtin_memcpy(shelf.action[0].name, name, kNameLength);
    shelf.seal();
    for (const std::int16_t down : {kOne, static_cast<std::int16_t>(-kOne)}) {
      FallingLoop lying;
      lying.actions = shelf.library();
      lying.command.request = Request::kGetUp;
      lying.inputs.accel_count[1] = down;
      lying.inputs.accel_count[2] = 0;
      follow(lying, 150);
    }
  }
}

// It sits, lies down by its action and lets go; then one forgets its action on the way.
void lie_down() {
  action::test::Shelf shelf = control::test::falling_shelf();
  __builtin_memcpy(shelf.action[0].name, action::kLieDown, kNameLength);
  shelf.seal();
  for (const int forgets : {300, 5}) {
    control::test::FallingLoop loop;
    loop.actions = shelf.library();
    follow(loop, 300);
    loop.command.request = Request::kRelax;
    while (!loop.is_in(safety::Mode::kLyingDown)) follow(loop, 1);
    follow(loop, forgets);
    loop.state.action = action::PlayerState{};
    follow(loop, 10);
  }
}

// Its operator is quiet while it walks any way, with and without steps of one length; then a servo
// is silent again and again.
void silence() {
  for (const float gain : {0.12F, 0.0F}) {
    for (const std::int16_t turn : {-300, 0, 300}) {
      control::test::Loop loop;
      loop.command.request = Request::kStand;
      follow(loop, 700);
      loop.state.tuning.gait.heading_gain = gain;
      loop.walk(1000);
      loop.command.vy_tenth_mm_s = turn;
      loop.command.wz_mrad_s = turn;
      follow(loop, 400);
      loop.inputs.flags = static_cast<std::uint16_t>(loop.inputs.flags & ~kCommandFresh);
      follow(loop, 300);
      loop.inputs.flags |= kCommandFresh;
      for (int tick = 0; tick < 300; ++tick) {
        loop.inputs.fresh = tick % 20 < 7 ? ~6U : ~0U;
        follow(loop, 1);
      }
    }
  }
}

// Its knee, its IMU, its soles lie while it walks; then they may: there is no IMU, or another
// controller's goals are sent.
void doubt() {
  enum class Lie { kKnee, kImu, kSoles, kNoImu, kForeign };
  for (const Lie lie : {Lie::kKnee, Lie::kImu, Lie::kSoles, Lie::kNoImu, Lie::kForeign}) {
    control::test::Loop loop;
    loop.walk(1778);
    follow(loop, 900);
    const std::int32_t stays = loop.inputs.position_count[test::kLeftLeg + 3];
    loop.noise = lie == Lie::kSoles || lie == Lie::kKnee;
    if (lie == Lie::kSoles) loop.inputs.flags |= kFeetFresh;
    if (lie == Lie::kNoImu) loop.inputs.flags |= kImuAssumed;
    if (lie == Lie::kForeign) loop.state.trust.foreign = 1;
    for (int tick = 0; tick < 600; ++tick) {
      if (lie == Lie::kKnee) loop.inputs.position_count[test::kLeftLeg + 3] = stays;
      if (lie == Lie::kImu) loop.inputs.gyro_count[tick / 50 % 3] = tick % 2 == 0 ? 8 : 0;
      if (lie == Lie::kImu) loop.inputs.accel_count[tick / 200 % 3] ^= 1;
      follow(loop, 1);
    }
  }
}

bool print(const char* what, const char* name, std::size_t ticks) {
  std::printf("%-12s %-22s %8zu%s\n", what, name, ticks, ticks > 0 ? "" : "  NEVER REACHED");
  return ticks > 0;
}

bool print_rows() {
  bool good = true;
  for (int i = 0; i < safety::kRows; ++i) {
    char name[64];
    const auto to = static_cast<int>(safety::kTable[i].to);
    std::snprintf(name, sizeof name, "%2d, to %s", i + 1, safety::kModeNames[to]);
    good = print("safety row", name, row_count[i]) && good;
  }
  return good;
}

bool print_faults() {
  constexpr struct {
    std::uint32_t bit;
    const char* name;
  } kFaults[] = {{safety::kFaultFall, "fall"},
                 {safety::kFaultEmergency, "emergency"},
                 {safety::kFaultServoSilent, "servo silent"},
                 {safety::kFaultImuSilent, "imu silent"},
                 {safety::kFaultOperatorQuiet, "operator quiet"},
                 {safety::kFaultTemperature, "temperature"},
                 {safety::kFaultVoltage, "voltage"},
                 {safety::kFaultServoError, "servo error"},
                 {safety::kFaultJointBeyond, "joint beyond"},
                 {safety::kFaultFlutter, "flutter"},
                 {safety::kFaultNotFollowing, "not following"},
                 {safety::kFaultUnloaded, "unloaded"},
                 {safety::kNoteOverrun, "overrun"},
                 {safety::kNoteParameter, "parameter"},
                 {safety::kNoteStrideLimited, "stride limited"},
                 {safety::kNotePlanShortened, "plan shortened"},
                 {safety::kNotePlanRefused, "plan refused"},
                 {safety::kNoteLegLimited, "leg limited"},
                 {safety::kNoteSpeedLimited, "speed limited"}};
  bool good = true;
  for (const auto& fault : kFaults) {
    good = print("fault", fault.name, fault_count[__builtin_ctz(fault.bit)]) && good;
  }
  return good;
}

}  // namespace
}  // namespace verp::replay

extern "C" {
verp::safety::Mode __real__ZN4verp6safety9next_modeENS0_4ModeEj(verp::safety::Mode, std::uint32_t);
verp::safety::Mode __wrap__ZN4verp6safety9next_modeENS0_4ModeEj(verp::safety::Mode mode,
                                                                std::uint32_t conditions) {
  verp::replay::note_row(mode, conditions);
  return __real__ZN4verp6safety9next_modeENS0_4ModeEj(mode, conditions);
}
}

int main(int count, char** argument) {
  using namespace verp;
  std::vector<replay::Segment> trace;
  if (count == 2) trace = replay::read_trace_file(argument[1]);
  if (trace.empty()) {
    std::fprintf(stderr, "usage: replay_reach FILE, where FILE is made by replay_make\n");
    return 2;
  }
  bool good = true;
  for (const replay::Segment& segment : trace) good = replay::run(segment) && good;
  replay::act();
  replay::fall();
  replay::lie_down();
  replay::silence();
  replay::doubt();
  constexpr const char* kPhases[] = {"idle", "start", "transition", "finalisation"};
  for (int i = 0; i < 4; ++i) {
    good = replay::print("gait phase", kPhases[i], replay::phase_count[i]) && good;
  }
  for (int i = 0; i < safety::kModes; ++i) {
    good = replay::print("safety mode", safety::kModeNames[i], replay::mode_count[i]) && good;
  }
  good = replay::print_rows() && good;
  good = replay::print_faults() && good;
  return good ? 0 : 1;
}
