#pragma once
#include <vector>

#include "host/robot/model/entity.hpp"

namespace verp::model {

/// A servo whose P gain the robot's file leaves open.
struct OpenGain {
  Servo* servo = nullptr;
  bool takes_d_gain = false;  ///< an eighth of it
};

/// N m/rad at the joint, to sag as little as robots that walk well, and less where the servo's own
/// damping would let the robot rock on it; 0: no legs. For `verp check`, and servos without p_gain.
double fitting_stiffness_n_m_rad(const Entity& entity, const Servo& servo);
/// P gain of this servo for that stiffness, within its range; 0: no legs.
std::uint16_t fitting_p_gain(const Entity& entity, const Servo& servo);

/// Gives each the P gain that fits the robot. The controller has room for 4 kinds of settings:
/// where that is too few, the nearest gains become one. Where damping bounds them, the gait looks
/// ahead by the lag that they have in common. Adds to `entity.defaults`.
void fit_gains(Entity& entity, const std::vector<OpenGain>& open);

}  // namespace verp::model
