#pragma once
#include "common/gait/footsteps.hpp"
#include "common/gait/whole_body.hpp"

/// The body's key points. A *head* runs ahead of the robot: it advances the pendulum's CoM, solves
/// the legs and weighs every link. A ring keeps the misses between the planned ZMP and that of all
/// links. Before the robot gets there, the pendulum turns them into a CoM correction (second stage
/// of preview control) and the key point is fixed.
namespace verp::gait {

inline constexpr int kRing = 32;     ///< key points, robot to head, and spare
inline constexpr int kHorizon = 24;  ///< key points of the head's lead (0.36 s at a 0.45 s cycle)
inline constexpr int kFixed = 16;    ///< fixed key points: two ahead, the rest for delayed joints

struct KeyPoint {
  Xy body_m;      ///< uncorrected
  Xy zmp_miss_m;  ///< planned minus multibody ZMP
  VERP_FIELDS(body_m, zmp_miss_m)
};
VERP_PACKED(KeyPoint);

struct PreviewState {
  KeyPoint ring[kRing];
  Xy fixed_m[kFixed];    ///< corrected body positions
  Xyz point_m[kPoints];  ///< link masses at the head
  Xy com_m;              ///< pendulum, at the head
  Xy offset_m[2];        ///< CoM minus body at the head, and one key point before
  Xy zmp_m;              ///< planned, at the head
  Xy com_real_m;         ///< CoM of all links at the head
  Xyz momentum_kg_m_s;   ///< between the head's last two key points
  Xy angular_kg_m2_s;    ///< likewise, x and y of the walk frame
  Xy correction_m;       ///< CoM correction at the last fixed key point
  Lump lump;
  float omega = 0;                         ///< 1/s, sqrt(g / CoM height)
  float body_per_com = 1;                  ///< body displacement per CoM displacement
  float leg_rad[kFeet * kLegJoints] = {};  ///< at the head; Newton's warm start
  std::uint8_t head_step = 0;              ///< index into the queue
  std::uint8_t head_key = 0;               ///< 1..key_points
  std::uint8_t head = 0;                   ///< key points laid since the walk's start, mod 256
  std::uint8_t fixed = 0;                  ///< key points fixed since the walk's start, mod 256
  VERP_FIELDS(ring, fixed_m, point_m, com_m, offset_m, zmp_m, com_real_m, momentum_kg_m_s,
              angular_kg_m2_s, correction_m, lump, omega, body_per_com, leg_rad, head_step,
              head_key, head, fixed)
};
VERP_PACKED(PreviewState);

/// Starts at rest in `stand`, already solved and weighed, CoM over `com_m`.
void begin(const Params& params, const Posture& stand, const Masses& masses, Xy com_m,
           PreviewState& state);

struct Laid {
  Xy zmp_miss_m;               ///< of the previous key point
  std::uint8_t leg_flags = 0;  ///< kinematics::LegFlag of both legs
};

/// Lays the head's next key point, from queue[head_step].
Laid lay_key_point(const Params& params, const Tuning& tuning, const Step* queue,
                   PreviewState& state);

/// Fixes the next key point by the misses beyond it.
void fix_key_point(const Step& step, PreviewState& state);

/// Body position `fraction` (0..1) after fixed key point `index` (mod 256), by a cubic through
/// four.
Xy body_at(const PreviewState& state, std::uint8_t index, float fraction);

/// Acceleration there, m/s^2, from second differences.
Xy body_acceleration(const PreviewState& state, std::uint8_t index, float fraction, float key_s);

/// Moves the walk frame's origin to `origin_m`.
void rebase(Xy origin_m, PreviewState& state);

}  // namespace verp::gait
