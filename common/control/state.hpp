#pragma once
#include "common/base/fields.hpp"
#include "common/model/tuning.hpp"
#include "common/record/digest.hpp"
#include "common/record/tick_record.hpp"

namespace verp {

/// All that one tick leaves for the next: copy it, and the run goes on the same. Hashed whole every tick.
struct State {
  TickDigest digest{.chain = record::kChainSeed};
  Tuning tuning;
  std::uint32_t started = 0;  ///< 0 until the first tick has copied Params::tuning
  VERP_FIELDS(digest, tuning, started)
};

}  // namespace verp
