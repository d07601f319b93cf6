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

/// This PC's State before the differing tick, and the Inputs that it assumed for that tick.
struct Suspicion {
  State before;
  Inputs inputs;
  std::uint64_t digest = 0;  ///< as received from the controller
};

/// The controller's records: the last tick that it holds, and those before it.
struct Testimony {
  app::HeldTick held;
  std::vector<TickRecord> ticks;  ///< oldest first, up to the held one
};

/// The TickRecords of an ImageKind::kTicks image that lead up to the held tick.
std::vector<TickRecord> ticks_of(const std::uint8_t* image, std::size_t size,
                                 const app::HeldTick& held);

enum class Verdict {
  kDifference,  ///< different results; the divergence names tick, stage and field
  kMisheard,    ///< equal results for the controller's Inputs; this PC assumed others
  kTooLate,     ///< the controller no longer has those ticks
};

struct Judgement {
  Verdict verdict = Verdict::kMisheard;
  record::Divergence divergence;  ///< for kMisheard: stage "inputs", and the fields misheard
};

/// Compares with the controller's own records. Left is the controller, right this PC.
Judgement judge(const Params& params, const action::Library& actions, const Suspicion& suspicion,
                const Testimony& testimony);

}  // namespace verp::shadow
