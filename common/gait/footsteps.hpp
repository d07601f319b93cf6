#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// Foot placement, extremes and ends first (paper): one step at a time, from the end of the
/// previous one and the present velocity order.
namespace verp::gait {

/// Body displacement of one step, in its own frame.
struct Stride {
  Xy by_m;
  float turn_rad = 0;
  VERP_FIELDS(by_m, turn_rad)
};
VERP_PACKED(Stride);

/// Compromises of the plan (FootstepState::notes).
enum PlanNote : std::uint16_t {
  kStrideLimited = 1 << 0,   ///< velocity needs more than max_step_m or max_turn_rad
  kReachShortened = 1 << 1,  ///< step shortened: leg too short at touch-down
  kZmpShortened = 1 << 2,    ///< step shortened: planned ZMP too near the sole's edge
  kPlanRefused = 1 << 3,     ///< no walk: a step on the spot leaves the soles, or soles overlap
  kStepWidened = 1 << 4,     ///< foot lands further out, beside the other sole
  kTurnShortened = 1 << 5,   ///< turns less: soles would overlap at any width
};

struct FootstepState {
  Stride stride;            ///< of the last planned step
  Foothold body;            ///< midpoint and heading of the feet after it
  float scale = 1;          ///< 0.1 to 1: shortens strides, to keep the ZMP in the sole
  std::uint8_t calm = 0;    ///< key points in a row with room for longer strides
  std::uint8_t made = 0;    ///< planned steps, modulo 8
  std::uint16_t notes = 0;  ///< PlanNote
  VERP_FIELDS(stride, body, scale, calm, made, notes)
};
VERP_PACKED(FootstepState);

struct VelocityIn {
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float heading_error_rad = 0;  ///< wanted minus actual; the next turn corrects a share
  bool stop = false;
  bool quick = false;  ///< with `stop`: the next step closes the feet
};

/// Room between two soles, across the better of two lines along a sole; up to 0 they may overlap.
/// Arguments are sole frames.
float soles_apart_m(const Params& params, const Foothold& left, const Foothold& right);

Xy sole_center(const Params& params, int side, const Foothold& foot);

/// Wanted ZMP: sole's centroid plus tuned offset, support_margin_m inside the edges.
Xy zmp_under(const Params& params, const GaitTuning& tuning, int side, const Foothold& foot);

/// Feet side by side about the origin, ZMP between them.
Step standing_feet(const Params& params, const GaitTuning& tuning);

/// Both feet stand; the ZMP moves from the middle under the first stance foot.
Step first_step(const Params& params, const GaitTuning& tuning, FootstepState& state);

/// First step of an immediate start: the ZMP rests. gait.cpp sets its place and duration.
Step hurried_step(const Params& params, const GaitTuning& tuning, FootstepState& state);
constexpr bool hurried(const Step& step) {
  return step.phase == Phase::kStart && step.swing == kBoth && step.double_support_s == 0.0F;
}

/// A step after `last` without motion.
Step rest_step(const GaitTuning& tuning, const Step& last);

/// The step after `last`. With `stop` strides shrink; once the feet are level, a final step
/// (Phase::kFinal, swing kBoth) returns the ZMP to the middle.
Step next_step(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
               const Step& last, FootstepState& state);

/// Undoes next_step(), which made `last`.
void take_back(const GaitTuning& tuning, const Step& last, FootstepState& state);

/// The same for the ZMP only: does not check the swing's path.
Step next_footholds(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
                    const Step& last, FootstepState& state);

}  // namespace verp::gait
