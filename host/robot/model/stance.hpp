#pragma once
#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"

/// Standing and walking values that the file omits, derived from the robot's legs, soles, mass and
/// servos. Requests that the legs cannot meet are errors at the file's line.
namespace verp::model {

/// Fills in omitted gait values and leg poses, with a line each in entity.defaults. Throws
/// LoadError for swapped legs, an unwalkable leg length, an unreachable hip height or pose, and
/// knees too weak for the robot.
void settle_stance(const Facts& facts, Entity& entity);

/// True if the legs reach the gait's standing posture; settle_stance() rejects a file otherwise.
bool can_stand(const Params& params);

/// Stiffness (N m/rad) at which a robot of this mass and leg sags as little as robots that walk
/// well; 0: no legs. Used by `verp check` and for servos without a p_gain.
double fitting_stiffness_n_m_rad(const Entity& entity);
/// P gain of this servo for that stiffness, within its range; 0: no legs.
std::uint16_t fitting_p_gain(const Entity& entity, const Servo& servo);

/// Hip height above the ankle in the standing pose, and the knee torque (N m) on one leg in it.
struct Stand {
  double hip_height_m = 0;
  double knee_n_m = 0;
};
Stand stand_of(const Entity& entity, const Limb& leg);

}  // namespace verp::model
