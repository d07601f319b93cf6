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

/// Names inside the MCAP file.
inline constexpr const char* kTickTopic =
    "/verp/tick";  ///< TickRecord bytes: all that replay needs
inline constexpr const char* kStateTopic =
    "/verp/state";  ///< State bytes after the tick of the same log time
inline constexpr const char* kChangedTopic =
    "/verp/changed";  ///< a person's change to the twin after the tick of the same log time
inline constexpr const char* kObjectsTopic =
    "/objects";  ///< poses of the movable objects in a twin's world, as transforms
inline constexpr const char* kParamsAttachment = "params";
inline constexpr const char* kActionsAttachment = "actions";
inline constexpr const char* kStateAttachment =
    "state";  ///< State before the first tick, if the run's beginning was cut off
inline constexpr const char* kStateLayoutAttachment = "state.layout";
inline constexpr const char* kMetadataName = "verp";
inline constexpr const char* kTraceFormat = "1";

/// Period of the kept States (design.md section 8). One is also kept at every change of the fault
/// bits.
inline constexpr std::uint64_t kKeyframeTicks = 125;

/// State after the tick at `index` of Trace::ticks.
struct Keyframe {
  std::size_t index = 0;
  State state;
};

/// A person's change to the twin after that tick; replay does not need it.
struct Change {
  std::uint32_t tick = 0;
  std::string what;
};

/// True pose of a twin's body at the tick at `index`.
struct BodyAt {
  std::size_t index = 0;
  ros::BodyPose pose;
};

/// Poses of the world's objects at the tick at `index`.
struct ObjectsAt {
  std::size_t index = 0;
  std::vector<ros::ObjectPose> objects;
};

/// One run of the controller, in memory: all that replay needs.
struct Trace {
  std::filesystem::path file;
  Params params;
  std::vector<std::uint32_t> actions;  ///< image of the action library; empty: the robot had none
  mcap::StringMap metadata;
  std::optional<State>
      before;  ///< State before the first tick; nullopt: the controller had just started
  std::vector<TickRecord> ticks;
  std::vector<Keyframe> keyframes;  ///< empty if the State layout of the writer differs from ours
  std::vector<Change> changes;
  std::vector<BodyAt> bodies;      ///< of some ticks; empty: no twin
  std::vector<ObjectsAt> objects;  ///< of some ticks; empty: nothing is movable
  std::string warning;             ///< with Read::kRecover: what is missing; else empty

  /// The 64-bit value that identifies the run; without ticks, the chain's seed.
  std::uint64_t digest() const {
    return ticks.empty() ? start().digest.chain : ticks.back().digest.chain;
  }
  State start() const { return before.value_or(State{}); }
  /// Valid while `actions` exists. Checks all actions, so call it once per run, not per tick.
  action::Library library() const { return {actions.data(), 4 * actions.size()}; }
  double period_s() const { return params.period_us * 1e-6; }
};

enum class Read {
  kStrict,   ///< any flaw is an error
  kRecover,  ///< keeps all before the flaw, and sets Trace::warning
};

/// Throws TraceError if the file is missing, truncated, edited, foreign or of another layout.
Trace read_trace(const std::filesystem::path& file, Read mode = Read::kStrict);

/// Version of the core that decided these ticks; empty: unknown.
std::string core_of(const Trace& trace);

/// This program's source revision, core version, compiler and flags, for metadata.
mcap::StringMap build_info();

struct RecordedPicture {
  std::string topic;
  std::uint64_t time_ns = 0;
  ros::Picture picture;
};
/// Calls `show` with each picture of a trace, in file order; returns their number. Throws
/// TraceError.
std::size_t for_each_picture(const std::filesystem::path& file,
                             const std::function<void(const RecordedPicture&)>& show);

}  // namespace verp::record
