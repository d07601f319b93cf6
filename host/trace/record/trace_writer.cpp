#include "host/trace/record/trace_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "common/model/leg.hpp"
#include "common/model/params.hpp"
#include "host/trace/record/fields.hpp"
#include "host/trace/record/ros_sensors.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::record {
namespace {

constexpr double kStick_m = 0.01;

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = c != '<' && c != '>' && c != '&' && c != '"' && c >= ' ';
    out += plain ? std::string(1, c) : fmt::format("&#{};", static_cast<unsigned char>(c));
  }
  return out;
}

std::string name_of(const Params& params, int node) {
  if (node == 0) return "body";
  const char* name = params.joint[node - 1].name;
  return escaped({name, ::strnlen(name, kNameLength)});
}

std::string xyz(const Xyz& v) {
  return fmt::format("{:g} {:g} {:g}", v.x, v.y, v.z);
}

/// A box from the link's origin to a joint on it.
std::string stick(const Xyz& to) {
  const double x = static_cast<double>(to.x), y = static_cast<double>(to.y),
               z = static_cast<double>(to.z), length_m = std::sqrt(x * x + y * y + z * z);
  if (length_m < kStick_m) return "";
  return fmt::format(
      "<visual><origin xyz=\"{:g} {:g} {:g}\" rpy=\"0 {:g} {:g}\"/><geometry>"
      "<box size=\"{:g} {:g} {:g}\"/></geometry></visual>",
      x / 2, y / 2, z / 2, std::atan2(-z, std::hypot(x, y)), std::atan2(y, x), length_m, kStick_m,
      kStick_m);
}

std::string link(const Params& params, int node) {
  const float mass_kg = node == 0 ? params.body_mass_kg : params.joint[node - 1].mass_kg;
  const Xyz& com_m = node == 0 ? params.body_com_m : params.joint[node - 1].com_link_m;
  std::string out = fmt::format(
      "<link name=\"{}\"><inertial><origin xyz=\"{}\"/><mass value=\"{:g}\"/><inertia ixx=\"1e-5\" "
      "ixy=\"0\" ixz=\"0\" iyy=\"1e-5\" iyz=\"0\" izz=\"1e-5\"/></inertial>"
      "<visual><geometry><sphere radius=\"{:g}\"/></geometry></visual>",
      name_of(params, node), xyz(com_m), mass_kg, kStick_m);
  for (int j = 0; j < params.joint_count; ++j) {
    if (params.joint[j].parent == node) out += stick(params.joint[j].origin_parent_m);
  }
  for (const LegParams& leg : params.leg) {
    if (leg.solver != LegSolver::kNone && model::last_joint(leg) == node - 1)
      out += stick(leg.sole_foot_m);
  }
  return out + "</link>\n";
}

std::string joint(const Params& params, int j) {
  const JointParams& p = params.joint[j];
  return fmt::format(
      "<joint name=\"{}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/><origin "
      "xyz=\"{}\"/><axis xyz=\"{}\"/><limit lower=\"{:g}\" upper=\"{:g}\" velocity=\"{:g}\" "
      "effort=\"0\"/></joint>\n",
      name_of(params, j + 1), name_of(params, p.parent), name_of(params, j + 1),
      xyz(p.origin_parent_m), xyz(p.axis), p.lower_rad, p.upper_rad, p.velocity_limit_rad_s);
}

/// A URDF for viewers: a link `body`, and one per joint with its name, mass and limits, drawn as
/// sticks to its joints.
std::string urdf(const Params& params) {
  std::string out = fmt::format("<robot name=\"{}\">\n",
                                escaped({params.name, ::strnlen(params.name, kNameLength)}));
  for (int node = 0; node <= params.joint_count; ++node) out += link(params, node);
  for (int j = 0; j < params.joint_count; ++j) out += joint(params, j);
  return out + "</robot>\n";
}

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
  const std::uint64_t time_ns = std::uint64_t{record.inputs.tick} * params_.period_us * 1000;
  writer_.add_message(tick_, time_ns, image(record));
  if (keep) writer_.add_message(state_, time_ns, image(state));
  if (options_.ros) append_ros(record.inputs, state, outputs, body, effort_n_m, time_ns);
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

void TraceWriter::append_ros(const Inputs& inputs, const State& state, const Outputs& outputs,
                             const ros::BodyPose* body, std::span<const double> effort_n_m,
                             std::uint64_t time_ns) {
  writer_.add_message(
      joints_, time_ns,
      ros::joint_state(params_, inputs.position_count, speeds_.after(inputs), effort_n_m, time_ns));
  writer_.add_message(goals_, time_ns,
                      ros::joint_state(params_, outputs.goal_count, {}, {}, time_ns));
  writer_.add_message(control_, time_ns, ros::control(params_, inputs, state, outputs));
  writer_.add_message(odometry_, time_ns, ros::estimated_odometry(params_, inputs, state, time_ns));
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
