#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/elementary.hpp"
#include "common/math/scalar.hpp"

/// Plain data of the gait. Lengths are in the *walk frame*: z up, ground at 0, x and y as the
/// body's at the start of the walk. Its origin moves with the robot once a step, so coordinates
/// stay small however far it walks: float32 resolves 1e-8 m at arm's length, and the multibody
/// correction takes second differences.
namespace verp::gait {

/// A point or vector on the ground.
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

/// Ground position of a sole frame's origin, and its heading.
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
/// Key points lie at half intervals, so both steps of a cycle hold the same 15 and left mirrors
/// right. Whole intervals (7.5 to a step) would not give that.
inline constexpr int kKeyPointsPerStep = 15;

/// One planned step: stance foot, swing foot's path and the ZMP. The ZMP moves in a straight line
/// from zmp_begin to zmp_end during double support, then rests.
struct Step {
  std::int32_t key_us = 0;      ///< time between key points
  std::uint8_t key_points = 0;  ///< duration is key_points * key_us
  std::uint8_t swing = kBoth;   ///< kLeft, kRight, or kBoth: no foot leaves the ground
  Phase phase = Phase::kIdle;
  std::uint8_t landed = kBoth;  ///< swing foot of the previous step; kBoth: none
  float double_support_s = 0;   ///< from the step's beginning
  float lift_m = 0;
  float touchdown_m = 0;  ///< height of the swing sole at the step's end
  float haste = 0;        ///< mean speed of the swing over an unhurried one, minus 1; 0 to 2
  float settle_m = 0;     ///< height of `landed` at the start; it comes down in two key times
  Foothold foot[kFeet];   ///< at the step's start
  Foothold landing;       ///< of the swing foot
  Xy bend_m;  ///< of its path at mid-swing, off the straight line, around the other foot
  Xy zmp_begin_m;
  Xy zmp_end_m;
  Xy dcm_end_m;  ///< divergent component of motion at the step's end
  VERP_FIELDS(key_us, key_points, swing, phase, landed, double_support_s, lift_m, touchdown_m,
              haste, settle_m, foot, landing, bend_m, zmp_begin_m, zmp_end_m, dcm_end_m)

  constexpr std::int32_t duration_us() const { return key_us * key_points; }
  constexpr float duration_s() const { return static_cast<float>(duration_us()) * 1e-6F; }
  constexpr float key_s() const { return static_cast<float>(key_us) * 1e-6F; }
  constexpr int carrying() const { return swing == kBoth ? kBoth : 1 - swing; }
  /// The final step and all later ones: both feet carry and the ZMP comes to rest.
  constexpr bool ends_walk() const { return swing == kBoth && phase != Phase::kStart; }
  /// Foothold at the end of the step.
  constexpr Foothold after(int side) const { return side == swing ? landing : foot[side]; }
};
VERP_PACKED(Step);

inline constexpr int kQueue = 4;  ///< the present step and at most three future ones

}  // namespace verp::gait
