#pragma once
#include "common/action/library.hpp"
#include "common/balance/attitude.hpp"
#include "common/control/state.hpp"

/// Falls in the tick: detects them before impact, and decides what a lying robot may do.
namespace verp::control {

/// Duration of a fall. From its detection (a third of a radian) to the ground an inverted pendulum
/// of 0.25 m takes 0.4 s; the rest is for the bounce.
inline constexpr std::int32_t kFallLasts_us = 700'000;
/// The robot gets up after being limp this long: it lies still, and the accelerometer rather than
/// the tumble gives its tilt.
inline constexpr std::int32_t kLieStill_us = 1'000'000;

/// Adds the conditions of a fall and of getting up. A robot without these actions (common/action)
/// gets neither: it falls limp and stays down.
void watch_fall(const Params& params, const action::Library& actions, State& state,
                const Inputs& inputs, const balance::AttitudeOut& attitude, AdmitOut& admitted);

/// The action that the present mode starts itself; 0: none.
std::uint8_t own_action(const action::Library& actions, const State& state);

}  // namespace verp::control
