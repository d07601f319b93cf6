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
  bool every_state = false;         ///< every State: a divergence names its field at its tick
  bool ros = true;                  ///< channels for viewers (host/guide/traces.md)
  std::uint64_t chunk_ticks = 125;  ///< most ticks that a crash can lose
  /// A chunk also ends at this size: ending one with a second's pictures took longer than a tick.
  std::size_t chunk_bytes = 1u << 17;
  std::vector<std::uint32_t> actions{};  ///< the controller's action library
  bool compress = false;                 ///< zstd, to about a fifth
  std::optional<State> before{};         ///< before the first tick of a cut run
  mcap::Listener* listener = nullptr;
};

/// Attaches the State that a replay starts from.
void add_state(mcap::Writer& writer, const State& before);

/// Writes a run as it happens. Throws TraceError if the file cannot be written.
class TraceWriter {
 public:
  /// `run` joins build_info() in the metadata: robot, seed, command line, ... Without `file` there
  /// is only the listener.
  TraceWriter(const std::filesystem::path& file, const Params& params, const mcap::StringMap& run,
              TraceOptions options = {});
  /// Without close(): keeps a part file that has a tick.
  ~TraceWriter();
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;

  /// Inputs with digests, then State and outputs. A twin adds the body's true pose (null: no /tf)
  /// and joint efforts, for which servos are not asked.
  void append(const TickRecord& record, const State& state, const Outputs& outputs,
              const ros::BodyPose* body = nullptr, std::span<const double> effort_n_m = {});
  /// A scan for viewers, measured up to that tick, on /SENSOR. Message: the tick's time; header:
  /// the measurement's. Needs TraceOptions::ros.
  void append(const std::string& sensor, std::uint32_t tick, const ros::LaserScan& scan);
  /// A message for viewers on `topic`, of one type. time_ns is on the ticks' clock and may go back.
  /// Needs TraceOptions::ros.
  void append(const std::string& topic, const ros::MessageType& type, std::uint64_t time_ns,
              std::string_view message);
  /// Poses after that tick; as often as the body's.
  void append(std::uint32_t tick, std::span<const ros::ObjectPose> objects);
  /// A user's change after that tick.
  void note(std::uint32_t tick, const std::string& what);
  /// `result` becomes metadata; the file gets its name.
  void close(const mcap::StringMap& result = {});

  void discard() { writer_.discard(); }
  /// Ticks that the operating system has: a crash of this program cannot lose them.
  std::uint64_t safe_ticks() const { return safe_ticks_; }

  const std::filesystem::path& part_path() const { return writer_.part_path(); }
  std::uint64_t ticks() const { return ticks_; }

 private:
  void begin(const mcap::StringMap& run);
  void append_ros(const Inputs& inputs, const State& state, const Outputs& outputs,
                  const ros::BodyPose* body, std::span<const double> effort_n_m,
                  std::uint64_t time_ns);

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
