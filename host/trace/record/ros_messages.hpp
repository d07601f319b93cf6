#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

/// ROS 2 messages in CDR, for common viewers. Derived from the tick; replay never reads them.
namespace verp::record::ros {

struct MessageType {
  std::string_view name, schema;
};

/// MCAP's "ros2msg" encoding, with dependencies.
extern const std::string_view kJointStateSchema;  ///< sensor_msgs/msg/JointState
extern const std::string_view kStringSchema;      ///< std_msgs/msg/String
extern const std::string_view kControlSchema;     ///< JSON schema
extern const std::string_view kImuSchema;         ///< sensor_msgs/msg/Imu
extern const std::string_view kTfSchema;          ///< tf2_msgs/msg/TFMessage

/// Position and orientation (x, y, z, w), world.
struct BodyPose {
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation_xyzw{0, 0, 0, 1};
};

struct ObjectPose {
  std::string name;
  BodyPose pose;
};
/// tf2_msgs/TFMessage with a transform per object, in the frame `parent`.
std::string objects(std::span<const ObjectPose> objects, std::uint64_t time_ns,
                    std::string_view parent = "world");
/// Decodes objects(). Empty: not such a message.
std::vector<ObjectPose> read_objects(std::string_view message);

/// First angle to last; inf: nothing within range.
struct LaserScan {
  std::string frame;
  double first_rad = 0, last_rad = 0, step_rad = 0, period_s = 0, min_m = 0, max_m = 0;
  std::vector<float> range_m;
  std::uint64_t age_ns = 0;  ///< at the first tick that could have it
};
extern const std::string_view kLaserScanSchema;  ///< sensor_msgs/msg/LaserScan
std::string laser_scan(const LaserScan& scan, std::uint64_t time_ns);

/// JointState: angles of position counts, optionally rad/s and N m.
std::string joint_state(const Params& params, const std::int32_t (&position_count)[kMaxJoints],
                        std::span<const double> velocity_rad_s, std::span<const double> effort_n_m,
                        std::uint64_t time_ns);
/// One tick of the controller as JSON by kControlSchema.
std::string control(const Params& params, const Inputs& inputs, const State& state,
                    const Outputs& outputs);
/// Gyro and accelerometer, rotated into the body frame; orientation is marked as unknown.
std::string imu(const Params& params, const Inputs& inputs, std::uint64_t time_ns);
/// Body, or the joint that moves the node.
std::string frame_of(const Params& params, int node);
/// world -> body, then parent to child link per joint, at the measured angle.
std::string transforms(const Params& params, const Inputs& inputs, const BodyPose& body,
                       std::uint64_t time_ns);

std::string string(std::string_view text);
/// nullopt: another message.
std::optional<std::string> read_string(std::string_view message);

/// The body's pose in a message of transforms(); nullopt: not such a message.
std::optional<BodyPose> body_pose(std::string_view transforms);

inline double joint_rad(const JointParams& joint, std::int32_t count) {
  if (joint.counts_per_rad == 0.0f) return 0;
  return (static_cast<double>(count) - static_cast<double>(joint.zero_count)) /
         static_cast<double>(joint.counts_per_rad);
}

}  // namespace verp::record::ros
