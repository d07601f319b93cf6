#include "host/robot/model/fit_gains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "common/model/params.hpp"
#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/params.hpp"

namespace verp::model {
namespace {

// Stiffness over weight times leg, 1/rad. Tuned: generic21 9.0, op3 12.5, darwin_op 7.4.
constexpr double kStiffness = 9.03;
// Softer than this, legs hardly hold the robot up: at 1, one ankle balances what tips it.
constexpr double kLeastStiffness = 1.2;
// Damping ratio of the robot's mass on one servo, at the leg's length. Measured with seed 1:
// Unitree's G1 falls at 0.075 and walks from 0.088 on, R1 falls at 0.088 and walks from 0.095 on.
// Gear friction damps hobby servos more.
constexpr double kDampingRatio = 0.095;
constexpr double kRocking_rad_s = 0.2;  // at which friction counts
constexpr double kGoalsWait_s = 0.005;  // for bus and profile
// Above it a servo buzzes; the table ends at 16383.
constexpr double kMostGain = 8000;

double leg_length_m(const Entity& entity) {
  const Limb* const leg = find_limb(entity, "left_leg");
  if (!leg) return 0;
  const LegGeometry g = classify_leg(entity, *leg);
  return g.thigh_m + g.shank_m;
}

double stiffness_n_m_rad(const Entity& entity, double over_weight_and_leg) {
  return over_weight_and_leg * total_mass(entity) * kGravity_m_s2 * leg_length_m(entity);
}

/// Its torque falls from stall to none at the no-load speed; N m s/rad.
double back_emf_n_m_s_rad(const Servo& servo) {
  return servo.stall_torque_n_m / servo.no_load_speed_rad_s;
}

/// With what its gears take from a slow rocking, the same energy a cycle.
double damping_n_m_s_rad(const Servo& servo) {
  const double friction = 4 / std::numbers::pi * servo.gearbox.f_base_n_m / kRocking_rad_s;
  return back_emf_n_m_s_rad(servo) + servo.gearbox.f_visc_n_m_s + friction;
}

/// Without hip yaw, which turns far less inertia.
std::vector<const Servo*> leg_servos(const Entity& entity) {
  std::vector<const Servo*> servos;
  for (const char* const name : {"left_leg", "right_leg"}) {
    const Limb* const leg = find_limb(entity, name);
    if (!leg) continue;
    const LegGeometry g = classify_leg(entity, *leg);
    for (std::size_t k = 1; k < g.joint.size(); ++k) {
      if (g.joint[k] >= 0)
        servos.push_back(&entity.joints[static_cast<std::size_t>(g.joint[k])].servo);
    }
  }
  return servos;
}

/// The goals wait for the servo's own lag, the bus and the profile.
double look_ahead_s(double rate_s) {
  return 1 / rate_s + kGoalsWait_s;
}

/// Stiffness over back-EMF, 1/s, the inverse of a servo's lag, at which the legs are damped. All
/// joints share the bound, so that they follow a step together. A servo too weak to be damped and
/// hold the robot has no say. Infinite: none needs a bound, or only one whose lag is within the
/// usual look-ahead; small robots walk worse with those (measured: ToddlerBot).
double most_rate_s(const Entity& entity) {
  const double weight_m = stiffness_n_m_rad(entity, 1), leg_m = leg_length_m(entity);
  const double inertia_kg_m2 = total_mass(entity) * leg_m * leg_m;
  double rate_s = INFINITY;
  for (const Servo* const servo : leg_servos(entity)) {
    const double half = damping_n_m_s_rad(*servo) / (2 * kDampingRatio);
    const double damped = half * half / inertia_kg_m2;
    if (damped >= kLeastStiffness * weight_m && damped < kStiffness * weight_m)
      rate_s = std::min(rate_s, damped / back_emf_n_m_s_rad(*servo));
  }
  return look_ahead_s(rate_s) > static_cast<double>(GaitTuning{}.look_ahead_s) ? rate_s : INFINITY;
}

void look_ahead(Entity& entity) {
  const std::string name = "gait.look_ahead_s";
  for (const auto& [given, value] : entity.tuning) {
    if (given == name) return;
  }
  const double most_s = static_cast<double>(kTuningRanges[*tuning_id(name)].high);
  const double value = std::min(look_ahead_s(most_rate_s(entity)), most_s);
  entity.tuning.emplace_back(name, value);
  entity.defaults.push_back(fmt::format("{} {:.4g}, from its servos' damping", name, value));
}

void put_gain(const OpenGain& open, std::uint16_t gain) {
  open.servo->p_gain = gain;
  if (open.takes_d_gain) open.servo->d_gain = static_cast<std::uint16_t>(gain / 8);
}

std::size_t kinds_of_settings(const Entity& entity) {
  std::set<std::tuple<int, int, int, int, int, bool>> kinds;
  for (const Joint& joint : entity.joints) {
    const Servo& s = joint.servo;
    if (joint.follows < 0)
      kinds.emplace(s.model_number, s.p_gain, s.i_gain, s.d_gain, s.profile_ms, s.fast_sync_read);
  }
  return kinds.size();
}

/// The two gains of one model whose ratio is least become their mean. False: there are no two.
bool merge_nearest(const std::vector<OpenGain>& open) {
  std::set<std::pair<int, std::uint16_t>> gains;
  for (const OpenGain& each : open) gains.emplace(each.servo->model_number, each.servo->p_gain);
  double least = INFINITY;
  std::pair<int, std::uint16_t> low, high;
  for (auto at = gains.begin(); at != gains.end(); ++at) {
    const auto next = std::next(at);
    if (next == gains.end() || next->first != at->first) continue;
    const double ratio = static_cast<double>(next->second) / at->second;
    if (ratio < least) least = ratio, low = *at, high = *next;
  }
  if (!std::isfinite(least)) return false;
  const auto mean =
      static_cast<std::uint16_t>(std::lround(std::sqrt(1.0 * low.second * high.second)));
  for (const OpenGain& each : open) {
    const std::pair<int, std::uint16_t> own{each.servo->model_number, each.servo->p_gain};
    if (own == low || own == high) put_gain(each, mean);
  }
  return true;
}

}  // namespace

double fitting_stiffness_n_m_rad(const Entity& entity, const Servo& servo) {
  const std::vector<const Servo*> legs = leg_servos(entity);
  const bool holds = std::any_of(legs.begin(), legs.end(),
                                 [&](const Servo* each) { return each->type == servo.type; });
  const double damped = most_rate_s(entity) * back_emf_n_m_s_rad(servo);
  const double least = holds ? stiffness_n_m_rad(entity, kLeastStiffness) : 0;
  return std::min(stiffness_n_m_rad(entity, kStiffness), std::max(damped, least));
}

std::uint16_t fitting_p_gain(const Entity& entity, const Servo& servo) {
  const double wanted = fitting_stiffness_n_m_rad(entity, servo);
  if (!(wanted > 0)) return 0;
  Servo unit = servo;
  unit.p_gain = 1;
  const bool fine = servo.most_gain > kMostGain;
  const double least = fine ? 50 : 1;
  const double most = fine ? kMostGain : servo.most_gain;
  return static_cast<std::uint16_t>(
      std::clamp(std::round(wanted / servo_stiffness_n_m_rad(unit)), least, most));
}

void fit_gains(Entity& entity, const std::vector<OpenGain>& open) {
  for (const OpenGain& each : open) put_gain(each, fitting_p_gain(entity, *each.servo));
  if (!open.empty() && std::isfinite(most_rate_s(entity))) look_ahead(entity);
  bool merged = false;
  while (kinds_of_settings(entity) > kServoProfiles && merge_nearest(open)) merged = true;
  std::map<std::string, std::uint16_t> fitted;
  for (const OpenGain& each : open) fitted[each.servo->type] = each.servo->p_gain;
  for (const auto& [type, gain] : fitted) {
    entity.defaults.push_back("p_gain " + std::to_string(gain) + " of " + type +
                              ", from its mass, legs and damping");
  }
  if (merged)
    entity.notes.push_back("the nearest P gains are one: the controller has room for 4 kinds");
}

}  // namespace verp::model
