#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "host/trace/record/joint_speeds.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

struct TraceOptions {
  bool every_state =
      false;        ///< keep State at every tick, so that any divergence names its field exactly
  bool ros = true;  ///< add channels for viewers (host/guide/traces.md)
  std::uint64_t chunk_ticks = 125;  ///< a crash loses at most this many
  /// Or as many as hold so much: in real time a chunk's end is part of a tick, and that of a second
  /// with pictures took longer than one.
  std::size_t chunk_bytes = 1u << 17;
  std::vector<std::uint32_t> actions{};  ///< image of the library that the controller has
  bool compress = false;                 ///< by zstd: about a fifth of the bytes
  std::optional<State> before{};         ///< the first tick, of a run whose beginning was cut off
  mcap::Listener* listener = nullptr;    ///< hears every message as it is written
};

/// The attachments that tell a replay with which State to begin.
void add_state(mcap::Writer& writer, const State& before);

/// Writes a run as it happens. Throws TraceError when the file cannot be written.
class TraceWriter {
 public:
  /// `run` joins build_info() in the metadata: robot, seed, command line, ... With an empty `file`
  /// there is none, only the listener.
  TraceWriter(const std::filesystem::path& file, const Params& params, const mcap::StringMap& run,
              TraceOptions options = {});
  /// Without close(): keeps the part file if a tick is in it.
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// One tick: what went in with its digests, State after it, what came out, and, if a twin knows,
  /// where the body really was (null: no /tf for this tick) and how hard each joint was driven.
  /// Servos are not asked for that: without a twin the effort stays empty.
  void append(const TickRecord& record, const State& state, const Outputs& outputs,
              const ros::BodyPose* body = nullptr, std::span<const double> effort_n_m = {});
  /// One tick of a run that is copied: with the State its trace kept, if it did (null: none).
  void append(const TickRecord& record, const State* kept);
  /// What a sensor that the controller does not have measured up to that tick, on /SENSOR. The
  /// message stands at the tick's time; its header has when it was measured. Nothing without
  /// TraceOptions::ros.
  void append(const std::string& sensor, std::uint32_t tick, const ros::LaserScan& scan);
  /// Any message of a viewer's, on `topic`, which has one type; time_ns: as ticks have it. May be
  /// older than what stands there. Nothing without TraceOptions::ros.
  void append(const std::string& topic, const ros::MessageType& type, std::uint64_t time_ns,
              std::string_view message);
  /// Where the twin's world had what can move in it after that tick; kept as often as the body.
  void append(std::uint32_t tick, std::span<const ros::ObjectPose> objects);
  /// What a person did to the twin after that tick.
  void note(std::uint32_t tick, const std::string& what);
  /// Adds `result` as metadata, ends the file and gives it its name.
  void close(const mcap::StringMap& result = {});

  /// Removes what was written; nothing may be added afterwards.
  void discard() { writer_.discard(); }
  /// Ticks that are with the operating system, whatever happens now.
  std::uint64_t safe_ticks() const { return safe_ticks_; }

  const std::filesystem::path& part_path() const { return writer_.part_path(); }
  std::uint64_t ticks() const { return ticks_; }

 private:
  void begin(const mcap::StringMap& run);
  /// What the controller made of a tick; null of one that is copied.
  struct Made {
    const State* state = nullptr;
    const Outputs* outputs = nullptr;
  };
  void put(const TickRecord& record, const State* kept, const Made& made, const ros::BodyPose* body,
           std::span<const double> effort_n_m);
  void append_ros(const Inputs& inputs, const Made& made, const ros::BodyPose* body,
                  std::span<const double> effort_n_m, std::uint64_t time_ns);

  mcap::Writer writer_;
  Params params_;
  TraceOptions options_;
  std::uint16_t tick_ = 0, state_ = 0, joints_ = 0, imu_ = 0, tf_ = 0, goals_ = 0, control_ = 0,
                odometry_ = 0;
  JointSpeeds speeds_;
  std::map<std::string, std::uint16_t> sensors_;
  std::optional<std::uint16_t> objects_;  ///< a channel of worlds in which something moves
  std::optional<std::uint16_t> changed_;  ///< a channel of runs in which something was
  std::uint64_t ticks_ = 0, safe_ticks_ = 0;
  std::uint32_t faults_ = 0;
};

}  // namespace verp::record
