#include "host/trace/record/ros_messages.hpp"

#include <cmath>
#include <cstring>

#include "host/trace/record/cdr.hpp"
#include "host/trace/record/ros_header.hpp"

namespace verp::record::ros {

const std::string_view kJointStateSchema = R"(std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
)" VERP_ROS_HEADER;

const std::string_view kLaserScanSchema = R"(std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
)" VERP_ROS_HEADER;

const std::string_view kImuSchema =
    R"(std_msgs/Header header
geometry_msgs/Quaternion orientation
float64[9] orientation_covariance
geometry_msgs/Vector3 angular_velocity
float64[9] angular_velocity_covariance
geometry_msgs/Vector3 linear_acceleration
float64[9] linear_acceleration_covariance
)" VERP_ROS_HEADER
    R"(================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
)";

const std::string_view kTfSchema =
    R"(geometry_msgs/TransformStamped[] transforms
================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
)" VERP_ROS_HEADER
    R"(================================================================================
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
)";

const std::string_view kStringSchema = "string data\n";

namespace {

std::string_view name_of(const JointParams& joint) {
  return {joint.name, ::strnlen(joint.name, kNameLength)};
}

std::array<double, 3> rotated(const float (&matrix)[9], const std::int16_t (&count)[3],
                              float scale) {
  std::array<double, 3> out{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      out[row] += static_cast<double>(matrix[3 * row + column]) * count[column];
    }
    out[row] *= static_cast<double>(scale);
  }
  return out;
}

}  // namespace

std::string joint_state(const Params& params, const std::int32_t (&position_count)[kMaxJoints],
                        std::span<const double> velocity_rad_s, std::span<const double> effort_n_m,
                        std::uint64_t time_ns) {
  Cdr out;
  const std::uint32_t count = params.joint_count;
  out.header(time_ns, "").put(count);
  for (std::uint32_t j = 0; j < count; ++j) out.text(name_of(params.joint[j]));
  out.put(count);
  for (std::uint32_t j = 0; j < count; ++j) {
    out.put(joint_rad(params.joint[j], position_count[j]));
  }
  out.put(static_cast<std::uint32_t>(velocity_rad_s.size())).doubles(velocity_rad_s);
  out.put(static_cast<std::uint32_t>(effort_n_m.size())).doubles(effort_n_m);
  return out.take();
}

std::string laser_scan(const LaserScan& scan, std::uint64_t time_ns) {
  Cdr out;
  out.header(time_ns, scan.frame);
  for (const double value :
       {scan.first_rad, scan.last_rad, scan.step_rad, 0.0, scan.period_s, scan.min_m, scan.max_m}) {
    out.put(static_cast<float>(value));
  }
  out.put(static_cast<std::uint32_t>(scan.range_m.size()));
  for (const float range_m : scan.range_m) out.put(range_m);
  out.put(std::uint32_t{0});
  return out.take();
}

std::string string(std::string_view text) {
  return Cdr().text(text).take();
}

std::optional<std::string> read_string(std::string_view message) {
  std::uint32_t size = 0;
  if (message.size() < 4 + sizeof size) return std::nullopt;
  std::memcpy(&size, message.data() + 4, sizeof size);
  const std::string_view text = message.substr(4 + sizeof size);
  if (size == 0 || text.size() != size) return std::nullopt;
  return std::string(text.substr(0, size - 1));
}

std::string imu(const Params& params, const Inputs& inputs, std::uint64_t time_ns) {
  constexpr std::array<double, 9> kUnknown{-1};  // in sensor_msgs/Imu, -1 means "not measured"
  constexpr std::array<double, 9> kNotGiven{};
  const ImuParams& p = params.imu;
  Cdr out;
  out.header(time_ns, "body").doubles(std::array<double, 4>{0, 0, 0, 1}).doubles(kUnknown);
  out.doubles(rotated(p.body_imu, inputs.gyro_count, p.gyro_rad_s_per_count)).doubles(kNotGiven);
  out.doubles(rotated(p.body_imu, inputs.accel_count, p.accel_m_s2_per_count)).doubles(kNotGiven);
  return out.take();
}

std::string frame_of(const Params& params, int node) {
  return node == 0 ? "body" : std::string(name_of(params.joint[node - 1]));
}

std::string transforms(const Params& params, const Inputs& inputs, const BodyPose& body,
                       std::uint64_t time_ns) {
  Cdr out;
  out.put(static_cast<std::uint32_t>(params.joint_count + 1));
  out.header(time_ns, "world").text("body");
  out.doubles(body.position_m).doubles(body.orientation_xyzw);
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const double half_rad = 0.5 * joint_rad(joint, inputs.position_count[j]);
    const Xyz& origin = joint.origin_parent_m;
    const Xyz& axis = joint.axis;
    out.header(time_ns, frame_of(params, joint.parent)).text(name_of(joint));
    for (const float value : {origin.x, origin.y, origin.z}) out.put(static_cast<double>(value));
    for (const float value : {axis.x, axis.y, axis.z}) {
      out.put(static_cast<double>(value) * std::sin(half_rad));
    }
    out.put(std::cos(half_rad));
  }
  return out.take();
}

std::optional<BodyPose> body_pose(std::string_view transforms) {
  const std::vector<ObjectPose> all = read_objects(transforms);
  if (all.empty()) return std::nullopt;
  return all.front().pose;
}

std::string objects(std::span<const ObjectPose> objects, std::uint64_t time_ns,
                    std::string_view parent) {
  Cdr out;
  out.put(static_cast<std::uint32_t>(objects.size()));
  for (const ObjectPose& object : objects) {
    out.header(time_ns, parent).text(object.name);
    out.doubles(object.pose.position_m).doubles(object.pose.orientation_xyzw);
  }
  return out.take();
}

std::vector<ObjectPose> read_objects(std::string_view message) {
  CdrReader in(message);
  std::vector<ObjectPose> out;
  for (auto left = in.get<std::uint32_t>(); in.good && left > 0; --left) {
    in.get<std::int32_t>();
    in.get<std::uint32_t>();
    in.text();
    const std::string_view name = in.text();
    BodyPose pose;
    for (double& value : pose.position_m) value = in.get<double>();
    for (double& value : pose.orientation_xyzw) value = in.get<double>();
    if (in.good) out.push_back({std::string(name), pose});
  }
  return in.good ? out : std::vector<ObjectPose>();
}

}  // namespace verp::record::ros
