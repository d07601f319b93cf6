#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"

/// Lengths are in the *walk frame*: z up, ground at 0, x and y the body's at the walk's start. Its
/// origin moves on once a step to keep coordinates small: the multibody correction takes second
/// differences.
namespace verp::gait {

struct Xy {
  float x = 0;
  float y = 0;
  VERP_FIELDS(x, y)
  constexpr friend Xy operator+(Xy a, Xy b) { return {a.x + b.x, a.y + b.y}; }
  constexpr friend Xy operator-(Xy a, Xy b) { return {a.x - b.x, a.y - b.y}; }
  constexpr friend Xy operator*(float s, Xy a) { return {s * a.x, s * a.y}; }
};
VERP_PACKED(Xy);

constexpr float dot(Xy a, Xy b) {
  return a.x * b.x + a.y * b.y;
}
constexpr Xy turned(Xy v, const math::SinCos& yaw) {
  return {yaw.cos * v.x - yaw.sin * v.y, yaw.sin * v.x + yaw.cos * v.y};
}
inline Xy turned(Xy v, float yaw_rad) {
  return turned(v, math::sincos(yaw_rad));
}

/// A sole frame's origin on the ground, and heading.
struct Foothold {
  Xy at_m;
  float yaw_rad = 0;
  VERP_FIELDS(at_m, yaw_rad)
};
VERP_PACKED(Foothold);

/// The paper's three phases, and standing.
enum class Phase : std::uint8_t { kIdle, kStart, kTransition, kFinal };

inline constexpr std::uint8_t kLeft = 0;
inline constexpr std::uint8_t kRight = 1;
inline constexpr std::uint8_t kBoth = 2;

inline constexpr int kIntervalsPerCycle =
    15;  ///< 16 states joined by 15 intervals (paper, section 4.1)
/// Key points lie at half intervals, so both steps of a cycle have the same number.
inline constexpr int kKeyPointsPerStep = 15;

/// Stance foot, swing path and ZMP, which moves straight from zmp_begin to zmp_end in double
/// support, then rests.
struct Step {
  std::int32_t key_us = 0;      ///< time between key points
  std::uint8_t key_points = 0;  ///< duration is key_points * key_us
  std::uint8_t swing = kBoth;   ///< kLeft, kRight, or kBoth: no foot leaves the ground
  Phase phase = Phase::kIdle;
  std::uint8_t landed = kBoth;  ///< previous step's swing foot; kBoth: none
  float double_support_s = 0;   ///< from the step's start
  float lift_m = 0;
  float touchdown_m = 0;  ///< swing sole, at the end
  float haste = 0;        ///< mean swing speed over an unhurried one, minus 1; 0 to 2
  float settle_m = 0;     ///< height of `landed` at the start, gone in two key times
  Foothold foot[kFeet];   ///< at the step's start
  Foothold landing;       ///< swing foot's
  Xy bend_m;              ///< off the straight way at mid-swing, around the other foot
  Xy zmp_begin_m;
  Xy zmp_end_m;
  Xy dcm_end_m;  ///< divergent component of motion at the end
  VERP_FIELDS(key_us, key_points, swing, phase, landed, double_support_s, lift_m, touchdown_m,
              haste, settle_m, foot, landing, bend_m, zmp_begin_m, zmp_end_m, dcm_end_m)

  constexpr std::int32_t duration_us() const { return key_us * key_points; }
  constexpr float duration_s() const { return static_cast<float>(duration_us()) * 1e-6F; }
  constexpr float key_s() const { return static_cast<float>(key_us) * 1e-6F; }
  constexpr int carrying() const { return swing == kBoth ? kBoth : 1 - swing; }
  /// Final and later steps: both feet carry, the ZMP comes to rest.
  constexpr bool ends_walk() const { return swing == kBoth && phase != Phase::kStart; }
  /// Foothold at the step's end.
  constexpr Foothold after(int side) const { return side == swing ? landing : foot[side]; }
};
VERP_PACKED(Step);

inline constexpr int kQueue = 4;  ///< the present step and three more

}  // namespace verp::gait
