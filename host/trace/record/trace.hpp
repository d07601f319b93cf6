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
    "/verp/changed";  ///< what a person did to the twin after the tick of the same log time
inline constexpr const char* kObjectsTopic =
    "/objects";  ///< where a twin's world had what can move in it, as transforms
inline constexpr const char* kParamsAttachment = "params";
inline constexpr const char* kActionsAttachment = "actions";
inline constexpr const char* kStateAttachment =
    "state";  ///< State before the first tick, of a run whose beginning was cut off
inline constexpr const char* kStateLayoutAttachment = "state.layout";
inline constexpr const char* kMetadataName = "verp";
inline constexpr const char* kTraceFormat = "1";

/// A run's State is kept this often (design.md section 8), and at every change of the fault bits.
inline constexpr std::uint64_t kKeyframeTicks = 125;

/// State after the tick at `index` of Trace::ticks.
struct Keyframe {
  std::size_t index = 0;
  State state;
};

/// What a person did to the twin after that tick; replay does not need it.
struct Change {
  std::uint32_t tick = 0;
  std::string what;
};

/// Where the body was at the tick at `index`, as a twin knew.
struct BodyAt {
  std::size_t index = 0;
  ros::BodyPose pose;
};

/// Where the world's things were at the tick at `index`.
struct ObjectsAt {
  std::size_t index = 0;
  std::vector<ros::ObjectPose> objects;
};

/// One run of the controller: everything replay needs, in memory.
struct Trace {
  std::filesystem::path file;
  Params params;
  std::vector<std::uint32_t> actions;  ///< image of the library; empty: the robot had none
  mcap::StringMap metadata;
  std::optional<State> before;  ///< the first tick; none: the controller had just started
  std::vector<TickRecord> ticks;
  std::vector<Keyframe> keyframes;  ///< empty when the writer's State had another layout
  std::vector<Change> changes;
  std::vector<BodyAt> bodies;      ///< of some ticks; empty: no twin was there
  std::vector<ObjectsAt> objects;  ///< of some ticks; empty: nothing could move
  std::string warning;             ///< read with Read::kRecover: what is missing; else empty

  /// The 64-bit value that names the whole run; the chain's seed when there are no ticks.
  std::uint64_t digest() const {
    return ticks.empty() ? start().digest.chain : ticks.back().digest.chain;
  }
  /// With which the controller met the first tick.
  State start() const { return before.value_or(State{}); }
  /// Valid while `actions` are. Checks all of them: once a run, not once a tick.
  action::Library library() const { return {actions.data(), 4 * actions.size()}; }
  double period_s() const { return params.period_us * 1e-6; }
};

enum class Read {
  kStrict,   ///< any flaw is an error
  kRecover,  ///< takes what stands before the flaw, and says so in Trace::warning
};

/// Throws TraceError: missing, truncated, edited, foreign or of another layout.
Trace read_trace(const std::filesystem::path& file, Read mode = Read::kStrict);

/// Version of the core that decided these ticks; empty: not known.
std::string core_of(const Trace& trace);

/// Source revision, version of the core, compiler and flags of this program, for metadata.
mcap::StringMap build_info();

/// What a camera saw, as its trace has it.
struct RecordedPicture {
  std::string topic;
  std::uint64_t time_ns = 0;
  ros::Picture picture;
};
/// Each picture in a trace, in the order of the file; returns how many there were. Throws
/// TraceError.
std::size_t for_each_picture(const std::filesystem::path& file,
                             const std::function<void(const RecordedPicture&)>& show);

}  // namespace verp::record
