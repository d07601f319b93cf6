#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "host/trace/record/mcap_format.hpp"
#include "host/trace/record/ros_camera.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::record {

inline constexpr const char* kTickTopic = "/verp/tick";  ///< TickRecords: all that replay needs
inline constexpr const char* kStateTopic =
    "/verp/state";  ///< State after the tick of that log time
inline constexpr const char* kChangedTopic = "/verp/changed";  ///< a user's change after that tick
inline constexpr const char* kObjectsTopic =
    "/objects";  ///< transforms of movable objects in a twin's world
inline constexpr const char* kParamsAttachment = "params";
inline constexpr const char* kActionsAttachment = "actions";
inline constexpr const char* kStateAttachment =
    "state";  ///< State before the first tick of a cut run
inline constexpr const char* kStateLayoutAttachment = "state.layout";
inline constexpr const char* kMetadataName = "verp";
inline constexpr const char* kTraceFormat = "1";

/// Period of kept States (design.md section 8); also kept at every change of the fault bits.
inline constexpr std::uint64_t kKeyframeTicks = 125;

struct Keyframe {
  std::size_t index = 0;
  State state;
};

/// The user's change to the twin after that tick; not for replay.
struct Change {
  std::uint32_t tick = 0;
  std::string what;
};

/// True pose at the tick at `index`.
struct BodyAt {
  std::size_t index = 0;
  ros::BodyPose pose;
};

/// World's objects at the tick at `index`.
struct ObjectsAt {
  std::size_t index = 0;
  std::vector<ros::ObjectPose> objects;
};

/// One run of the controller, in memory: all that replay needs.
struct Trace {
  std::filesystem::path file;
  Params params;
  std::vector<std::uint32_t> actions;  ///< image of the action library; may be empty
  mcap::StringMap metadata;
  std::optional<State> before;  ///< State before the first tick; nullopt: a fresh controller
  std::vector<TickRecord> ticks;
  std::vector<Keyframe> keyframes;  ///< empty: the writer's State layout differs
  std::vector<Change> changes;
  std::vector<BodyAt> bodies;      ///< some ticks; empty: no twin
  std::vector<ObjectsAt> objects;  ///< some ticks; empty: nothing is movable
  std::string warning;             ///< Read::kRecover: missing parts

  /// Identifies the run; without ticks, the chain's seed.
  std::uint64_t digest() const {
    return ticks.empty() ? start().digest.chain : ticks.back().digest.chain;
  }
  State start() const { return before.value_or(State{}); }
  /// Valid while `actions` exists. Checks all actions: call it once per run.
  action::Library library() const { return {actions.data(), 4 * actions.size()}; }
  double period_s() const { return params.period_us * 1e-6; }
};

enum class Read {
  kStrict,   ///< any flaw is an error
  kRecover,  ///< all before the flaw, with a warning
  kSalvage,  ///< also what stands behind damaged chunks: ticks are missing in between
};

/// Throws TraceError if missing, truncated, edited, foreign or of another layout.
Trace read_trace(const std::filesystem::path& file, Read mode = Read::kStrict);

/// Empty: unknown.
std::string core_of(const Trace& trace);

/// Source revision, core version, compiler and flags.
mcap::StringMap build_info();

struct RecordedPicture {
  std::string topic;
  std::uint64_t time_ns = 0;
  ros::Picture picture;
};
/// Calls `show` in file order; returns their number. Throws TraceError.
std::size_t for_each_picture(const std::filesystem::path& file,
                             const std::function<void(const RecordedPicture&)>& show);

}  // namespace verp::record
