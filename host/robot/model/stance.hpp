#pragma once
#include "host/robot/model/entity.hpp"
#include "host/robot/model/facts.hpp"

/// Stance values that the file omits, from legs, soles, mass and servos. Requests beyond the legs
/// are errors at the file's line.
namespace verp::model {

/// Fills in gait values and leg poses, with a line each in entity.defaults. Throws LoadError for
/// swapped legs, an unwalkable length, an unreachable height or pose, and weak knees.
void settle_stance(const Facts& facts, Entity& entity);

/// True if the legs reach the gait's stand; settle_stance() rejects other files.
bool can_stand(const Params& params);

/// Hip above ankle, and knee torque (N m) on one leg.
struct Stand {
  double hip_height_m = 0;
  double knee_n_m = 0;
};
Stand stand_of(const Entity& entity, const Limb& leg);

}  // namespace verp::model
