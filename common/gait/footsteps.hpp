#pragma once
#include "common/gait/types.hpp"
#include "common/model/params.hpp"

/// Foot placement: extremes and ends first, as in the paper. Each step follows from the end of the
/// previous one and the present velocity order.
namespace verp::gait {

/// Displacement of the body in one step, in its own frame.
struct Stride {
  Xy by_m;
  float turn_rad = 0;
  VERP_FIELDS(by_m, turn_rad)
};
VERP_PACKED(Stride);

/// Bits of FootstepState::notes: compromises of the plan. Reported, not fatal.
enum PlanNote : std::uint16_t {
  kStrideLimited = 1 << 0,   ///< wanted velocity needs more than max_step_m or max_turn_rad
  kReachShortened = 1 << 1,  ///< step shortened: a leg would be too short at touch-down
  kZmpShortened = 1 << 2,   ///< step shortened: the planned ZMP would come too near the sole's edge
  kPlanRefused = 1 << 3,    ///< no walk: even a step on the spot leaves the support polygon, or the
                            ///< standing soles overlap
  kStepWidened = 1 << 4,    ///< the foot lands further out, beside the other sole
  kTurnShortened = 1 << 5,  ///< the step turns less: the soles would overlap at any width
};

struct FootstepState {
  Stride stride;            ///< of the last planned step
  Foothold body;            ///< midpoint and heading of the feet after the last planned step
  float scale = 1;          ///< 0.1 to 1: factor on strides that keeps the ZMP in the sole
  std::uint8_t calm = 0;    ///< consecutive key points at which shortened strides could be longer
  std::uint8_t made = 0;    ///< planned steps, modulo 8
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

/// Distance between two soles across the better of the two lines along a sole. Not above 0 if they
/// may overlap. `left` and `right` are the soles' frames.
float soles_apart_m(const Params& params, const Foothold& left, const Foothold& right);

/// Centroid of a sole on the ground.
Xy sole_center(const Params& params, int side, const Foothold& foot);

/// Wanted ZMP under a stance sole: its centroid plus the tuned offset, at least support_margin_m
/// inside the edges.
Xy zmp_under(const Params& params, const GaitTuning& tuning, int side, const Foothold& foot);

/// Both feet side by side about the origin, with the ZMP between them: the state before and after
/// every walk.
Step standing_feet(const Params& params, const GaitTuning& tuning);

/// The first step: both feet stay on the ground, and the ZMP moves from the middle to the first
/// stance foot.
Step first_step(const Params& params, const GaitTuning& tuning, FootstepState& state);

/// First step of a robot that has to step at once. It is so short that the ZMP rests at one place;
/// gait.cpp computes place and duration from the steps that follow.
Step hurried_step(const Params& params, const GaitTuning& tuning, FootstepState& state);
constexpr bool hurried(const Step& step) {
  return step.phase == Phase::kStart && step.swing == kBoth && step.double_support_s == 0.0F;
}

/// A step after `last` without motion.
Step rest_step(const GaitTuning& tuning, const Step& last);

/// The step after `last`. With `stop` set strides shrink. When the feet are level, the next step is
/// the final one (Phase::kFinal, swing kBoth): the ZMP returns to the middle.
Step next_step(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
               const Step& last, FootstepState& state);

/// The same without checking the swing's path: enough to compute the ZMP.
Step next_footholds(const Params& params, const GaitTuning& tuning, const VelocityIn& wanted,
                    const Step& last, FootstepState& state);

}  // namespace verp::gait
