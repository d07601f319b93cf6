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
      false;        ///< keeps every State, so that a divergence names its field at its own tick
  bool ros = true;  ///< adds channels for viewers (host/guide/traces.md)
  std::uint64_t chunk_ticks = 125;  ///< most ticks that a crash can lose
  /// A chunk also ends at this size: a chunk's end is part of a tick, and that of a second with
  /// pictures took longer than a tick.
  std::size_t chunk_bytes = 1u << 17;
  std::vector<std::uint32_t> actions{};  ///< image of the controller's action library
  bool compress = false;                 ///< by zstd, to about a fifth
  std::optional<State>
      before{};  ///< State before the first tick, if the run's beginning was cut off
  mcap::Listener* listener = nullptr;
};

/// Attaches the State from which a replay starts.
void add_state(mcap::Writer& writer, const State& before);

/// Writes a run as it happens. Throws TraceError if the file cannot be written.
class TraceWriter {
 public:
  /// `run` adds to build_info() in the metadata: robot, seed, command line, ... With an empty
  /// `file` there is only the listener.
  TraceWriter(const std::filesystem::path& file, const Params& params, const mcap::StringMap& run,
              TraceOptions options = {});
  /// Without close(): keeps the part file if it contains a tick.
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// One tick: inputs with digests, State after it, outputs. A twin adds the body's true pose
  /// (null: no /tf) and each joint's effort, for which servos are not asked.
  void append(const TickRecord& record, const State& state, const Outputs& outputs,
              const ros::BodyPose* body = nullptr, std::span<const double> effort_n_m = {});
  /// One tick of a copied run. `kept`: the State that its trace kept, or null.
  void append(const TickRecord& record, const State* kept);
  /// A scan that the controller does not see, measured up to that tick, on /SENSOR. The message has
  /// the tick's time, its header the measurement's. Does nothing without TraceOptions::ros.
  void append(const std::string& sensor, std::uint32_t tick, const ros::LaserScan& scan);
  /// A message for viewers on `topic`, which has one type. time_ns is on the ticks' clock and may
  /// be older than earlier messages. Does nothing without TraceOptions::ros.
  void append(const std::string& topic, const ros::MessageType& type, std::uint64_t time_ns,
              std::string_view message);
  /// Poses of the movable objects in the twin's world after that tick; kept as often as the body.
  void append(std::uint32_t tick, std::span<const ros::ObjectPose> objects);
  /// A person's change to the twin after that tick.
  void note(std::uint32_t tick, const std::string& what);
  /// Adds `result` as metadata, ends the file and renames it.
  void close(const mcap::StringMap& result = {});

  void discard() { writer_.discard(); }
  /// Ticks that the operating system has, and that a crash cannot lose.
  std::uint64_t safe_ticks() const { return safe_ticks_; }

  const std::filesystem::path& part_path() const { return writer_.part_path(); }
  std::uint64_t ticks() const { return ticks_; }

 private:
  void begin(const mcap::StringMap& run);
  /// The controller's result of a tick; null in a copied run.
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
  std::optional<std::uint16_t> objects_;
  std::optional<std::uint16_t> changed_;
  std::uint64_t ticks_ = 0, safe_ticks_ = 0;
  std::uint32_t faults_ = 0;
};

}  // namespace verp::record
