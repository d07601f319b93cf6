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

/// What this PC had before the tick that differs, and what it took for that tick's Inputs.
struct Suspicion {
  State before;
  Inputs inputs;
  std::uint64_t digest = 0;  ///< that the controller was heard to tell
};

/// What the controller had: the last tick that it holds, and those before it.
struct Testimony {
  app::HeldTick held;
  std::vector<TickRecord> ticks;  ///< the oldest first; up to the one that is held
};

/// Those of an image of ImageKind::kTicks that led to the tick held.
std::vector<TickRecord> ticks_of(const std::uint8_t* image, std::size_t size,
                                 const app::HeldTick& held);

enum class Verdict {
  kDifference,  ///< not the same bits; the divergence names tick, stage and field
  kMisheard,    ///< the same bits for what the controller had; this PC took something else
  kTooLate,     ///< the controller no longer has the ticks in question
};

struct Judgement {
  Verdict verdict = Verdict::kMisheard;
  record::Divergence divergence;  ///< of kMisheard: stage "inputs", and what was misheard
};

/// Compares on the controller's own word. Left is the controller, right this PC.
Judgement judge(const Params& params, const action::Library& actions, const Suspicion& suspicion,
                const Testimony& testimony);

}  // namespace verp::shadow
