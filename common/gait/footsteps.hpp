#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// Where the feet go: the extremes and ends first, as in the paper. One step is made at a time,
/// from the ends of the one before it and the velocity wanted now.
namespace verp::gait {

/// Displacement of the body in one step, in its own frame.
struct Stride {
  Xy by_m;
  float turn_rad = 0;
  VERP_FIELDS(by_m, turn_rad)
};
VERP_PACKED(Stride);

/// Bits of FootstepState::notes: what the plan had to give up. Reported, not fatal.
enum PlanNote : std::uint16_t {
  kStrideLimited = 1 << 0,   ///< velocity wanted needs longer steps than max_step_m or max_turn_rad
  kReachShortened = 1 << 1,  ///< step shortened: a leg would be too short at touch-down
  kZmpShortened = 1 << 2,   ///< step shortened: the planned ZMP would come too near the sole's edge
  kPlanRefused = 1 << 3,    ///< even a step on the spot leaves the support polygon, or the soles
                            ///< overlap where they stand: not walking
  kStepWidened = 1 << 4,    ///< foot set down further out, beside the other sole
  kTurnShortened = 1 << 5,  ///< step turns less: the soles would overlap however wide it may be
};

struct FootstepState {
  Stride stride;    ///< of the last step made
  Foothold body;    ///< midpoint and heading the steps are laid around, after the last step made
  float scale = 1;  ///< 0.1 to 1: how far strides are shortened to keep the ZMP in the sole
  std::uint8_t calm = 0;  ///< key points on end at which strides, being shortened, could be longer
  std::uint8_t made = 0;  ///< steps, modulo 8
  std::uint16_t notes = 0;  ///< PlanNote
  VERP_FIELDS(stride, body, scale, calm, made, notes)
};
VERP_PACKED(FootstepState);

struct VelocityIn {
  float vx_m_s = 0;
  float vy_m_s = 0;
  float wz_rad_s = 0;
  float heading_error_rad =
      0;  ///< wanted minus actual heading; a share of it is added to the next turn
  bool stop = false;
};

/// Room between two soles, across the better of the two lines that run along one of them; not above
/// 0: they may overlap. `left` and `right` are where the soles' frames stand.
float soles_apart_m(const Params& params, const Foothold& left, const Foothold& right);

/// Centroid of a sole on the ground.
Xy sole_center(const Params& params, int side, const Foothold& foot);

/// ZMP wanted under a carrying sole: its centroid moved by the tuned offset, at least
/// support_margin_m inside the sole's edges.
Xy zmp_under(const Params& params, const GaitTuning& tuning, int side, const Foothold& foot);

/// Both feet side by side about the origin, the ZMP in the middle of their soles: before and after
/// every walk.
Step standing_feet(const Params& params, const GaitTuning& tuning);

/// The first step: no foot leaves the ground, the ZMP goes from the middle to under the first
/// carrying foot.
Step first_step(const Params& params, const GaitTuning& tuning, FootstepState& state);

/// The first step of a robot that has to step at once: so short that the ZMP rests at one place.
/// Which place and how short follow from the steps after it, once they are known (gait.cpp).
Step hurried_step(const Params& params, const GaitTuning& tuning, FootstepState& state);
constexpr bool hurried(const Step& step) {
  return step.phase == Phase::kStart && step.swing == kBoth && step.double_support_s == 0.0F;
}

/// A step in which nothing moves, after `last`.
Step rest_step(const GaitTuning& tuning, const Step& last);

/// The step after `last`. Once `stop` is set strides shrink; when the feet are level the step made
/// is the final one, in which the ZMP returns to the middle (Phase::kFinal, swing kBoth).
Step next_step(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
               const Step& last, FootstepState& state);

/// The same without a look at the swing's way: enough to see where the ZMP will go.
Step next_footholds(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
                    const Step& last, FootstepState& state);

}  // namespace verp::gait
