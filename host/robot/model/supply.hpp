#pragma once
#include "host/robot/model/entity.hpp"

namespace verp::model {

/// Unloaded: the file's, or what the servos are made for.
double supply_volts(const Entity& entity);

/// Battery and harness: the file's, or an estimate. The estimate is 0.1 ohm at 12 V (three LiPo
/// cells of about 10 mOhm, as hobby packs of 1 to 2 Ah have, plug, fuse, first metre of daisy
/// chain). It grows with the voltage squared, so that equal power loses an equal share. Servos
/// stronger than generic21's have a pack of as many times less resistance.
double supply_resistance_ohm(const Entity& entity);

/// One line for people.
std::string supply_text(const Entity& entity);

}  // namespace verp::model
