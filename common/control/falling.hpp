#pragma once
#include "common/action/library.hpp"
#include "common/balance/attitude.hpp"
#include "common/control/state.hpp"

namespace verp::control {

/// An inverted pendulum of 0.25 m takes 0.4 s from detection (a third of a radian) to the ground;
/// the rest is bouncing.
inline constexpr std::int32_t kFallLasts_us = 700'000;
/// The robot gets up after it was limp for this long: it lies still, and the accelerometer gives
/// its tilt.
inline constexpr std::int32_t kLieStill_us = 1'000'000;

/// Sets the conditions of a fall and of getting up. Without the actions (common/action) it falls
/// limp and stays down.
void watch_fall(const Params& params, const action::Library& actions, State& state,
                const Inputs& inputs, const balance::AttitudeOut& attitude, AdmitOut& admitted);

/// The action that the mode starts itself; 0: none.
std::uint8_t own_action(const action::Library& actions, const State& state);

}  // namespace verp::control
