#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/trace/record/replay.hpp"

namespace verp::shadow {

/// This PC's State before the differing tick, and its assumed Inputs.
struct Suspicion {
  State before;
  Inputs inputs;
  std::uint64_t digest = 0;  ///< the controller's
};

/// The last tick that the controller holds, and those before it.
struct Testimony {
  app::HeldTick held;
  std::vector<TickRecord> ticks;  ///< oldest first
};

/// Ticks of an ImageKind::kTicks image up to the held one.
std::vector<TickRecord> ticks_of(const std::uint8_t* image, std::size_t size,
                                 const app::HeldTick& held);

enum class Verdict {
  kDifference,  ///< other results; the divergence names tick, stage and field
  kMisheard,    ///< equal results for the controller's Inputs
  kTooLate,     ///< dropped by the controller
};

struct Judgement {
  Verdict verdict = Verdict::kMisheard;
  record::Divergence divergence;  ///< for kMisheard: stage "inputs"
};

/// Left is the controller, right this PC.
Judgement judge(const Params& params, const action::Library& actions, const Suspicion& suspicion,
                const Testimony& testimony);

}  // namespace verp::shadow
