#include "common/gait/preview.hpp"

#include "common/gait/dcm.hpp"
#include "common/math/spline.hpp"
#include "common/model/tree.hpp"

namespace verp::gait {
namespace {

/// Indices of the rings count modulo 256.
constexpr std::uint8_t wrapped(int index) {
  return static_cast<std::uint8_t>(index);
}

struct Momentum {
  Vec3 linear;
  Xy angular;  // about x and y through the origin
};

// p x dp summed over the masses between two key points: (a + b) / 2 x (b - a) is a x b.
Momentum momentum_between(const Params& params, const PreviewState& state, const Masses& now,
                          float key_s) {
  Momentum sum{Vec3::Zero(), {}};
  for (int i = 0; i < kPoints; ++i) {
    const float mass_kg = point_mass_kg(params, state.lump, i);
    const Vec3 a = math::to_vec(state.point_m[i]);
    const Vec3& b = now.point_m[i];
    sum.linear += mass_kg * (b - a);
    sum.angular.x += mass_kg * (a.y() * b.z() - a.z() * b.y());
    sum.angular.y += mass_kg * (a.z() * b.x() - a.x() * b.z());
  }
  const float per_s = 1.0F / key_s;
  return {per_s * sum.linear, per_s * sum.angular};
}

// Where the ground balances gravity and inertia of all links.
Xy multibody_zmp(const PreviewState& state, const Momentum& next, float mass_kg, float key_s) {
  const float weight_n = mass_kg * math::kGravityMS2;
  const float force_n = weight_n + (next.linear.z() - state.momentum_kg_m_s.z) / key_s;
  const float moment_x = (next.angular.x - state.angular_kg_m2_s.x) / key_s;
  const float moment_y = (next.angular.y - state.angular_kg_m2_s.y) / key_s;
  if (!(force_n > 0.1F * weight_n)) return state.com_real_m;  // nearly in flight: no ZMP
  return {(weight_n * state.com_real_m.x - moment_y) / force_n,
          (weight_n * state.com_real_m.y + moment_x) / force_n};
}

Xy ground(const Vec3& v) {
  return {v.x(), v.y()};
}

Xy fixed_at(const PreviewState& state, std::uint8_t index, int ahead) {
  return state.fixed_m[static_cast<std::uint8_t>(index + ahead) % kFixed];
}

}  // namespace

void begin(const Params& params, const Posture& stand, const Masses& masses, Xy com_m,
           PreviewState& state) {
  for (int i = 0; i < kPoints; ++i) state.point_m[i] = math::to_xyz(masses.point_m[i]);
  const Xy body_m = ground(stand.body.position_m);
  state.com_m = com_m;
  state.com_real_m = ground(masses.com_m);
  state.offset_m[0] = state.offset_m[1] = state.com_real_m - body_m;
  state.zmp_m = com_m;
  state.momentum_kg_m_s = Xyz{};
  state.angular_kg_m2_s = state.correction_m = Xy{};
  state.omega = math::sqrt(math::kGravityMS2 / math::max(masses.com_m.z(), 0.05F));
  state.body_per_com = 1.0F / com_share(params, state.lump, stand, masses);
  for (KeyPoint& key : state.ring) key = KeyPoint{body_m, Xy{}};
  for (Xy& fixed : state.fixed_m) fixed = body_m;
  state.head_step = state.head_key = state.head = state.fixed = 0;
}

Laid lay_key_point(const Params& params, const Tuning& tuning, const Step* queue,
                   PreviewState& state) {
  if (state.head_key >= queue[state.head_step].key_points) {
    ++state.head_step;
    state.head_key = 0;
  }
  const Step& step = queue[state.head_step];
  const float key_s = step.key_s();
  const float time_s = key_s * static_cast<float>(state.head_key + 1);
  state.com_m = com_after(step, state.omega, state.com_m, time_s - key_s, time_s);
  // The offset changes slowly: extrapolate. The multibody ZMP corrects the error.
  const Xy offset_m = 2.0F * state.offset_m[0] - state.offset_m[1];
  const Xy body_m = state.com_m - offset_m;
  const Posture posture = posture_of(params, tuning.gait, body_m, foot_at(step, kLeft, time_s),
                                     foot_at(step, kRight, time_s));
  const Masses masses = weigh(params, state.lump, posture, state.leg_rad);
  const Momentum momentum = momentum_between(params, state, masses, key_s);
  const Xy zmp_m = multibody_zmp(state, momentum, masses.mass_kg, key_s);
  const Xy miss_m = state.zmp_m - zmp_m;

  state.ring[state.head % kRing].zmp_miss_m = miss_m;
  state.head = wrapped(state.head + 1);
  ++state.head_key;
  state.ring[state.head % kRing] = KeyPoint{body_m, Xy{}};
  for (int i = 0; i < kPoints; ++i) state.point_m[i] = math::to_xyz(masses.point_m[i]);
  state.momentum_kg_m_s = math::to_xyz(momentum.linear);
  state.angular_kg_m2_s = momentum.angular;
  state.zmp_m = zmp_at(step, time_s);
  state.com_real_m = ground(masses.com_m);
  state.offset_m[1] = state.offset_m[0];
  state.offset_m[0] = state.com_real_m - body_m;
  return {miss_m, masses.leg_flags};
}

void fix_key_point(const Step& step, PreviewState& state) {
  state.fixed = wrapped(state.fixed + 1);
  const float keep = math::exp(-state.omega * step.key_s());
  Xy dcm_m{};  // of the correction, backwards
  for (std::uint8_t i = wrapped(state.head - 1); i != wrapped(state.fixed - 1);
       i = wrapped(i - 1)) {
    const Xy miss_m = state.ring[i % kRing].zmp_miss_m;
    dcm_m = miss_m + keep * (dcm_m - miss_m);
  }
  state.fixed_m[state.fixed % kFixed] =
      state.ring[state.fixed % kRing].body_m + state.body_per_com * state.correction_m;
  state.correction_m = dcm_m + keep * (state.correction_m - dcm_m);
}

Xy body_at(const PreviewState& state, std::uint8_t index, float fraction) {
  const Xy before = fixed_at(state, index, -1), from = fixed_at(state, index, 0);
  const Xy to = fixed_at(state, index, 1), after = fixed_at(state, index, 2);
  const Xy slope_from = 0.5F * (to - before);
  const Xy slope_to = 0.5F * (after - from);
  return {math::hermite(from.x, slope_from.x, to.x, slope_to.x, fraction).value,
          math::hermite(from.y, slope_from.y, to.y, slope_to.y, fraction).value};
}

Xy body_acceleration(const PreviewState& state, std::uint8_t index, float fraction, float key_s) {
  const Xy before = fixed_at(state, index, -1), from = fixed_at(state, index, 0);
  const Xy to = fixed_at(state, index, 1), after = fixed_at(state, index, 2);
  const Xy here = (before - from) + (to - from);
  const Xy there = (from - to) + (after - to);
  return (1.0F / math::square(key_s)) * (here + fraction * (there - here));
}

void rebase(Xy origin_m, PreviewState& state) {
  for (KeyPoint& key : state.ring) key.body_m = key.body_m - origin_m;
  for (Xy& fixed : state.fixed_m) fixed = fixed - origin_m;
  for (Xyz& point : state.point_m) {
    point.x -= origin_m.x;
    point.y -= origin_m.y;
  }
  state.com_m = state.com_m - origin_m;
  state.zmp_m = state.zmp_m - origin_m;
  state.com_real_m = state.com_real_m - origin_m;
  // Angular momentum about the new origin: L - origin x P.
  const float pz = state.momentum_kg_m_s.z;
  state.angular_kg_m2_s.x -= origin_m.y * pz;
  state.angular_kg_m2_s.y += origin_m.x * pz;
}

}  // namespace verp::gait
