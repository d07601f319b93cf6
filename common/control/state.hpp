#pragma once
#include "common/action/player.hpp"
#include "common/balance/attitude.hpp"
#include "common/balance/estimator.hpp"
#include "common/balance/feedback.hpp"
#include "common/balance/gravity.hpp"
#include "common/balance/landing.hpp"
#include "common/balance/lean.hpp"
#include "common/balance/stepping.hpp"
#include "common/balance/zeros.hpp"
#include "common/base/fields.hpp"
#include "common/control/admit.hpp"
#include "common/gait/gait.hpp"
#include "common/model/tuning.hpp"
#include "common/record/digest.hpp"
#include "common/record/tick_record.hpp"
#include "common/safety/limit.hpp"
#include "common/safety/machine.hpp"
#include "common/safety/trust.hpp"

namespace verp {

/// The ordered heading, to which the walk is corrected.
struct SteerState {
  float heading_rad = 0;
  float slip_rad = 0;          ///< integral of the heading error
  std::int32_t fallen_us = 0;  ///< how long the tilt has exceeded its limit
  VERP_FIELDS(heading_rad, slip_rad, fallen_us)
};
VERP_PACKED(SteerState);

/// Everything that a tick leaves for the next: a copy continues with the same bits. Digested every
/// tick.
struct State {
  TickDigest digest{.chain = record::kChainSeed};
  Tuning tuning;  ///< in force: Params::tuning and parameter writes
  safety::TrustState trust;
  AdmitState admit;
  balance::AttitudeState attitude;
  balance::EstimatorState estimator;
  SteerState steer;
  gait::GaitState gait;
  balance::SteppingState stepping;
  balance::LeanState lean;
  balance::FeedbackOut feedback;
  balance::ZeroState zeros;
  balance::LandingState landing;
  balance::DriveState drive;
  safety::LimitState limit;
  safety::MachineState machine;
  action::PlayerState action;
  VERP_FIELDS(digest, tuning, trust, admit, attitude, estimator, steer, gait, stepping, lean,
              feedback, zeros, landing, drive, limit, machine, action)
};
VERP_PACKED(State);
static_assert(sizeof(State) <= 3072, "hashed State is at most 3 KB");

}  // namespace verp
