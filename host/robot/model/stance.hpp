#pragma once
#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"

/// How a robot stands and walks where its file is silent: from its own legs, soles, mass and
/// servos. And what those legs cannot do, refused where the file asks for it.
namespace verp::model {

/// Fills in the gait values and leg poses that the file leaves open, with a line each in
/// entity.defaults. Throws LoadError for swapped legs, legs of a length that nobody walks on, a hip
/// height or pose that they can't take, and knees that can't carry the robot.
void settle_stance(const Facts& facts, Entity& entity);

/// Whether the legs can take the posture in which the gait stands, its numbers being what they are:
/// settle_stance refuses a file of which they cannot.
bool can_stand(const Params& params);

/// What settle_stance leaves to `verp check` and the p_gain of servos that give none: the stiffness
/// (N m/rad) at which a robot of this mass and leg sags as little as those that walk well; 0: no
/// legs to say.
double fitting_stiffness_n_m_rad(const Entity& entity);
/// The P gain with which this servo has that stiffness, within what it takes; 0: no legs to say.
std::uint16_t fitting_p_gain(const Entity& entity, const Servo& servo);

/// Hip height that the standing pose gives, above the ankle; and the torque (N m) that one knee
/// holds when the robot stands so on one leg.
struct Stand {
  double hip_height_m = 0;
  double knee_n_m = 0;
};
Stand stand_of(const Entity& entity, const Limb& leg);

}  // namespace verp::model
