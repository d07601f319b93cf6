#pragma once
#include "common/action/library.hpp"
#include "common/balance/attitude.hpp"
#include "common/control/state.hpp"

/// Falls within the tick: seen before the ground is met, and what a robot that lies may be asked.
namespace verp::control {

/// A fall lasts so long: from where it is seen (a third of a radian) to the ground an inverted
/// pendulum of 0.25 m takes 0.4 s, and what it strikes bounces for the rest.
inline constexpr std::int32_t kFallLasts_us = 700'000;
/// A robot gets up when it has been limp for so long: it lies still, and its tilt is the
/// accelerometer's, not that of a tumble.
inline constexpr std::int32_t kLieStill_us = 1'000'000;

/// Conditions of a fall, and of getting up. Without the actions for them (common/action) there are
/// none: such a robot falls limp, and stays down.
void watch_fall(const Params& params, const action::Library& actions, State& state,
                const Inputs& inputs, const balance::AttitudeOut& attitude, AdmitOut& admitted);

/// The action that the mode plays by itself; 0: none.
std::uint8_t own_action(const action::Library& actions, const State& state);

}  // namespace verp::control
