#include <cstddef>
#include <cstring>
#include <string>

#include "common/control/state.hpp"
#include "host/apps/libverp/failure.hpp"
#include "host/trace/record/fields.hpp"
#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace_parts.hpp"

using namespace verp::abi;

// The structs of verp.h have the controller's layout.
static_assert(sizeof(verp_command) == sizeof(verp::Command));
static_assert(offsetof(verp_command, head_tilt_mrad) == offsetof(verp::Command, head_tilt_mrad));
static_assert(sizeof(verp_inputs) == sizeof(verp::Inputs));
static_assert(offsetof(verp_inputs, command) == offsetof(verp::Inputs, command));
static_assert(offsetof(verp_inputs, gyro_count) == offsetof(verp::Inputs, gyro_count));
static_assert(offsetof(verp_inputs, foot_count) == offsetof(verp::Inputs, foot_count));
static_assert(offsetof(verp_inputs, slow_joint) == offsetof(verp::Inputs, slow_joint));
static_assert(offsetof(verp_inputs, position_count) == offsetof(verp::Inputs, position_count));
static_assert(sizeof(verp_outputs) == sizeof(verp::Outputs));
static_assert(offsetof(verp_outputs, mode) == offsetof(verp::Outputs, mode));
static_assert(offsetof(verp_outputs, goal_count) == offsetof(verp::Outputs, goal_count));
static_assert(VERP_MAX_JOINTS == verp::kMaxJoints && VERP_LEG_JOINTS == verp::kLegJoints);

namespace {

template <class Struct>
const char* layout_of(const char* name) {
  static const std::string text = verp::record::describe_layout<Struct>(name);
  return text.c_str();
}

}  // namespace

uint32_t verp_abi(void) {
  return VERP_ABI;
}

const char* verp_version(void) {
  static const std::string revision = verp::record::build_info().at("source_revision");
  return revision.c_str();
}

const char* verp_layout(const char* name) {
  const std::string wanted = name == nullptr ? "" : name;
  if (wanted == "inputs") return layout_of<verp::Inputs>("inputs");
  if (wanted == "outputs") return layout_of<verp::Outputs>("outputs");
  if (wanted == "state") return layout_of<verp::State>("state");
  if (wanted == "params") return layout_of<verp::Params>("params");
  return nullptr;
}

int verp_replay(const char* file, uint64_t* ticks, uint64_t* digest) {
  return call("verp_replay", [&]() -> int {
    need_text(file, "file");
    verp::record::TraceFile trace(file, verp::record::Read::kStrict);
    const verp::record::ReplayResult result = verp::record::replay(trace);
    if (ticks != nullptr) *ticks = result.ticks;
    if (digest != nullptr) *digest = result.replayed_digest;
    if (!result.divergence) return VERP_OK;
    throw Failure(VERP_DIFFERS,
                  std::string(file) + ": diverges at " +
                      text(*result.divergence, trace.head().params, "recorded", "replayed"));
  });
}
