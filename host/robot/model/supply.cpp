#include "host/robot/model/supply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace verp::model {
namespace {

constexpr double kPack_v = 12, kPack_ohm = 0.1;
// All servos stalled: generic21's 21 XM430-W210 take 579.6 W.
constexpr double kPack_w = 580;

double made_for_v(const Entity& entity) {
  return entity.joints.empty() ? 0.0 : entity.joints[0].servo.nominal_v;
}

double stall_w(const Entity& entity) {
  double sum = 0;
  for (const Joint& joint : entity.joints) {
    if (joint.follows < 0) sum += joint.servo.nominal_v * joint.servo.stall_current_a;
  }
  return sum;
}

}  // namespace

double supply_volts(const Entity& entity) {
  return entity.supply.volts.value_or(made_for_v(entity));
}

double supply_resistance_ohm(const Entity& entity) {
  if (entity.supply.resistance_ohm) return *entity.supply.resistance_ohm;
  const double stronger = std::max(1.0, stall_w(entity) / kPack_w);
  return kPack_ohm * std::pow(made_for_v(entity) / kPack_v, 2) / stronger;
}

std::string supply_text(const Entity& entity) {
  return fmt::format("supply: {:.4g} V{}, {:.3g} ohm{}", supply_volts(entity),
                     entity.supply.volts ? "" : " as its servos", supply_resistance_ohm(entity),
                     entity.supply.resistance_ohm
                         ? ""
                         : fmt::format(", an estimate for servos that take {:.3g} W when all stall",
                                       stall_w(entity)));
}

}  // namespace verp::model
