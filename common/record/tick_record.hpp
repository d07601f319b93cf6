#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/io/io.hpp"

/// Per tick in a trace: names the first stage that differs in a replay.
namespace verp {

/// The stages of step(), in order.
enum class Stage : std::uint8_t { kAdmit, kEstimate, kPlan, kBalance, kKinematics, kLimit, kGate };
inline constexpr int kStages = 7;
inline constexpr const char* kStageNames[kStages] = {"admit",      "estimate", "plan", "balance",
                                                     "kinematics", "limit",    "gate"};

/// Digests of each stage's state and output; `chain` covers all earlier ticks too.
struct TickDigest {
  std::uint64_t chain = 0;
  std::uint32_t stage[kStages] = {};
  std::uint32_t reserved = 0;
  VERP_FIELDS(chain, stage, reserved)
};
VERP_PACKED(TickDigest);

struct TickRecord {
  TickDigest digest;
  Inputs inputs;
  VERP_FIELDS(digest, inputs)
};
VERP_PACKED(TickRecord);

}  // namespace verp
