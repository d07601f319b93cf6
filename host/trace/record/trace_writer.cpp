#include "host/trace/record/trace_writer.hpp"

#include <algorithm>

#include "host/trace/record/fields.hpp"
#include "host/trace/record/ros_sensors.hpp"
#include "host/trace/record/trace_error.hpp"
#include "host/trace/record/urdf.hpp"

namespace verp::record {
namespace {

constexpr std::uint64_t kTransformTicks = 4;  // 25 per second at 100 Hz

template <class T>
std::string_view image(const T& value) {
  static_assert(packed_size<T>() == sizeof(T));
  return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

}  // namespace

void add_state(mcap::Writer& writer, const State& before) {
  writer.add_attachment(kStateAttachment, "application/octet-stream", image(before));
  writer.add_attachment(kStateLayoutAttachment, "text/plain", describe_layout<State>("State"));
}

TraceWriter::TraceWriter(const std::filesystem::path& file, const Params& params,
                         const mcap::StringMap& run, TraceOptions options)
    : writer_(file, options.ros ? "ros2" : "", "verp",
              options.compress ? mcap::Compression::kZstd : mcap::Compression::kNone,
              options.listener),
      params_(params),
      options_(std::move(options)),
      speeds_(params) {
  try {
    begin(run);
  } catch (const TraceError&) {
    writer_.discard();  // there is no trace yet
    throw;
  }
}

void TraceWriter::begin(const mcap::StringMap& run) {
  mcap::StringMap metadata = run;
  metadata.merge(build_info());
  metadata.insert_or_assign("format", std::string(kTraceFormat));
  writer_.add_metadata(kMetadataName, metadata);
  writer_.add_attachment(kParamsAttachment, "application/octet-stream", image(params_));
  if (!options_.actions.empty()) {
    writer_.add_attachment(
        kActionsAttachment, "application/octet-stream",
        {reinterpret_cast<const char*>(options_.actions.data()), 4 * options_.actions.size()});
  }
  writer_.add_attachment("params.layout", "text/plain", describe_layout<Params>("Params"));
  if (options_.before) add_state(writer_, *options_.before);

  const auto raw = [&](const char* topic, const char* name, const std::string& layout) {
    return writer_.add_channel(writer_.add_schema(name, "verp", layout), topic, "verp");
  };
  tick_ = raw(kTickTopic, "verp/TickRecord", describe_layout<TickRecord>("TickRecord"));
  state_ = raw(kStateTopic, "verp/State", describe_layout<State>("State"));
  if (options_.ros) {
    const auto add = [&](const char* topic, const char* name, std::string_view schema) {
      return writer_.add_channel(writer_.add_schema(name, "ros2msg", schema), topic, "cdr");
    };
    joints_ = add("/joint_states", "sensor_msgs/msg/JointState", ros::kJointStateSchema);
    imu_ = add("/imu", "sensor_msgs/msg/Imu", ros::kImuSchema);
    tf_ = add("/tf", "tf2_msgs/msg/TFMessage", ros::kTfSchema);
    goals_ = add("/joint_goals", "sensor_msgs/msg/JointState", ros::kJointStateSchema);
    control_ = writer_.add_channel(
        writer_.add_schema("verp.Control", "jsonschema", ros::kControlSchema), "/control", "json");
    odometry_ = add("/odom", ros::kOdometry.name.data(), ros::kOdometry.schema);
    const auto robot = add("/robot_description", "std_msgs/msg/String", ros::kStringSchema);
    writer_.add_message(robot, 0, ros::string(urdf(params_)));
  }
  writer_.flush();
}

TraceWriter::~TraceWriter() {
  if (ticks_ == 0) writer_.discard();
}

void TraceWriter::append(const TickRecord& record, const State& state, const Outputs& outputs,
                         const ros::BodyPose* body, std::span<const double> effort_n_m) {
  const bool keep =
      options_.every_state || ticks_ % kKeyframeTicks == 0 || outputs.faults != faults_;
  faults_ = outputs.faults;
  put(record, keep ? &state : nullptr, {&state, &outputs}, body, effort_n_m);
}

void TraceWriter::append(const TickRecord& record, const State* kept) {
  put(record, kept, {}, nullptr, {});
}

void TraceWriter::put(const TickRecord& record, const State* kept, const Made& made,
                      const ros::BodyPose* body, std::span<const double> effort_n_m) {
  const std::uint64_t time_ns = std::uint64_t{record.inputs.tick} * params_.period_us * 1000;
  writer_.add_message(tick_, time_ns, image(record));
  if (kept != nullptr) writer_.add_message(state_, time_ns, image(*kept));
  if (options_.ros) append_ros(record.inputs, made, body, effort_n_m, time_ns);
  ++ticks_;
  if (ticks_ % options_.chunk_ticks != 0 && writer_.open_bytes() < options_.chunk_bytes) return;
  writer_.flush();
  safe_ticks_ = ticks_;
}

void TraceWriter::append(const std::string& sensor, std::uint32_t tick,
                         const ros::LaserScan& scan) {
  const std::uint64_t time_ns = std::uint64_t{tick} * params_.period_us * 1000;
  append("/" + sensor, {"sensor_msgs/msg/LaserScan", ros::kLaserScanSchema}, time_ns,
         ros::laser_scan(scan, time_ns - std::min(time_ns, scan.age_ns)));
}

void TraceWriter::append(const std::string& topic, const ros::MessageType& type,
                         std::uint64_t time_ns, std::string_view message) {
  if (!options_.ros) return;
  if (!sensors_.contains(topic)) {
    sensors_[topic] =
        writer_.add_channel(writer_.add_schema(type.name, "ros2msg", type.schema), topic, "cdr");
  }
  writer_.add_message(sensors_[topic], time_ns, message);
}

void TraceWriter::append(std::uint32_t tick, std::span<const ros::ObjectPose> objects) {
  if (!options_.ros || objects.empty() || (ticks_ - 1) % kTransformTicks != 0) return;
  if (!objects_) {
    objects_ =
        writer_.add_channel(writer_.add_schema("tf2_msgs/msg/TFMessage", "ros2msg", ros::kTfSchema),
                            kObjectsTopic, "cdr");
  }
  const std::uint64_t time_ns = std::uint64_t{tick} * params_.period_us * 1000;
  writer_.add_message(*objects_, time_ns, ros::objects(objects, time_ns));
}

void TraceWriter::note(std::uint32_t tick, const std::string& what) {
  if (!changed_) {
    changed_ = writer_.add_channel(
        writer_.add_schema("std_msgs/msg/String", "ros2msg", ros::kStringSchema), kChangedTopic,
        "cdr");
  }
  writer_.add_message(*changed_, std::uint64_t{tick} * params_.period_us * 1000, ros::string(what));
}

void TraceWriter::append_ros(const Inputs& inputs, const Made& made, const ros::BodyPose* body,
                             std::span<const double> effort_n_m, std::uint64_t time_ns) {
  writer_.add_message(
      joints_, time_ns,
      ros::joint_state(params_, inputs.position_count, speeds_.after(inputs), effort_n_m, time_ns));
  if (made.outputs != nullptr) {
    writer_.add_message(goals_, time_ns,
                        ros::joint_state(params_, made.outputs->goal_count, {}, {}, time_ns));
    writer_.add_message(control_, time_ns,
                        ros::control(params_, inputs, *made.state, *made.outputs));
    writer_.add_message(odometry_, time_ns,
                        ros::estimated_odometry(params_, inputs, *made.state, time_ns));
  }
  writer_.add_message(imu_, time_ns, ros::imu(params_, inputs, time_ns));
  if (body != nullptr && ticks_ % kTransformTicks == 0) {
    writer_.add_message(tf_, time_ns, ros::transforms(params_, inputs, *body, time_ns));
  }
}

void TraceWriter::close(const mcap::StringMap& result) {
  writer_.flush();
  safe_ticks_ = ticks_;
  if (!result.empty()) writer_.add_metadata("result", result);
  writer_.close();
}

}  // namespace verp::record
