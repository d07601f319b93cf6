#include "common/control/falling.hpp"

namespace verp::control {
namespace {

using safety::Mode;

// Capture point as an angle: tilt plus rate times sqrt(height / g). A CoM 0.25 m high gives 0.16 s;
// a taller robot's fall is seen slightly late.
constexpr float kLookAhead_s = 0.16F;
// No step catches the body beyond it.
constexpr float kNoReturn_rad = 0.7F;
// A knock turns a body fast, not far.
constexpr float kLeastTilt_rad = 0.25F;
constexpr int kConfirm_ms = 20;
constexpr float kLeastLevel = 0.05F;  // too upright for a fall direction

float tilt_rate_rad_s(const Vec3& up, float level, const balance::AttitudeOut& attitude) {
  if (level < kLeastLevel) return 0.0F;
  return (attitude.roll_rate_rad_s * up.y() - attitude.pitch_rate_rad_s * up.x()) / level;
}

bool will_meet_ground(const State& state, const balance::AttitudeOut& attitude) {
  const Vec3 up = math::to_vec(state.attitude.up_body);
  const float level = math::hypot(up.x(), up.y());
  const float tilt_rad = math::atan2(level, up.z());
  return tilt_rad > kLeastTilt_rad &&
         tilt_rad + kLookAhead_s * tilt_rate_rad_s(up, level, attitude) > kNoReturn_rad;
}

// By the lower side; sitting or kneeling, by the side it leans to.
std::uint8_t get_up_action(const action::Library& actions, const State& state) {
  const Xyz& up = state.attitude.up_body;
  const std::uint8_t aside =
      actions.number_of(up.y < 0.0F ? action::kGetUpLeft : action::kGetUpRight);
  if (math::abs(up.y) > math::abs(up.x) && aside != 0) return aside;
  return actions.number_of(up.x < 0.0F ? action::kGetUpFront : action::kGetUpBack);
}

}  // namespace

void watch_fall(const Params& params, const action::Library& actions, State& state,
                const Inputs& inputs, const balance::AttitudeOut& attitude, AdmitOut& admitted) {
  const bool falls = safety::has_torque(state.machine.mode) && will_meet_ground(state, attitude);
  const int falling_ms = state.machine.falling_ms + static_cast<int>(params.period_us / 1000);
  state.machine.falling_ms = static_cast<std::uint8_t>(!falls             ? 0
                                                       : falling_ms < 255 ? falling_ms
                                                                          : 255);
  if (state.machine.falling_ms > kConfirm_ms && actions.number_of(action::kFallSafe) != 0) {
    admitted.conditions |= safety::kFallSeen;
  }
  if (actions.number_of(action::kLieDown) != 0) admitted.conditions |= safety::kLiesDown;
  if (inputs.command.request == Request::kGetUp && !safety::has_torque(state.machine.mode) &&
      state.machine.in_mode_us >= kLieStill_us && get_up_action(actions, state) != 0) {
    admitted.conditions |= safety::kAskGetUp;
  }
}

std::uint8_t own_action(const action::Library& actions, const State& state) {
  switch (state.machine.mode) {
    case Mode::kFalling:
      return actions.number_of(action::kFallSafe);
    case Mode::kGettingUp:
      return get_up_action(actions, state);
    case Mode::kLyingDown:
      return actions.number_of(action::kLieDown);
    default:
      return 0;
  }
}

}  // namespace verp::control
