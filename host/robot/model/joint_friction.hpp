#pragma once
#include "host/robot/model/facts.hpp"

namespace verp::model {

/// Joints have the friction of their servo type's gears and that of the file (SDF and URDF
/// <dynamics>). <verp:friction> drops one of them; without it they add up, which is said in notes.
void choose_friction(const Facts& facts, Entity& entity);

}  // namespace verp::model
