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

/// ROS 2 messages in CDR, so that the viewers roboticists use open a trace as it is. Derived from
/// the tick's inputs; replay never reads them.
namespace verp::record::ros {

/// A message's name, and its definition with its dependencies.
struct MessageType {
  std::string_view name, schema;
};

/// Message definitions with their dependencies, as MCAP's "ros2msg" schema encoding wants them.
extern const std::string_view kJointStateSchema;  ///< sensor_msgs/msg/JointState
extern const std::string_view kStringSchema;      ///< std_msgs/msg/String
extern const std::string_view kControlSchema;     ///< JSON schema
extern const std::string_view kImuSchema;         ///< sensor_msgs/msg/Imu
extern const std::string_view kTfSchema;          ///< tf2_msgs/msg/TFMessage

/// Position and orientation (x, y, z, w) of the body in the world.
struct BodyPose {
  std::array<double, 3> position_m{};
  std::array<double, 4> orientation_xyzw{0, 0, 0, 1};
};

/// A thing of the world, and where it is in it.
struct ObjectPose {
  std::string name;
  BodyPose pose;
};
/// tf2_msgs/TFMessage, one transform for each, in the frame `parent`.
std::string objects(std::span<const ObjectPose> objects, std::uint64_t time_ns,
                    std::string_view parent = "world");
/// What objects() was given. Empty: it is no such message.
std::vector<ObjectPose> read_objects(std::string_view message);

/// Of one laser, from the first angle to the last; inf: nothing within range.
struct LaserScan {
  std::string frame;
  double first_rad = 0, last_rad = 0, step_rad = 0, period_s = 0, min_m = 0, max_m = 0;
  std::vector<float> range_m;
  std::uint64_t age_ns = 0;  ///< at the time of the tick at which somebody could have it
};
extern const std::string_view kLaserScanSchema;  ///< sensor_msgs/msg/LaserScan
std::string laser_scan(const LaserScan& scan, std::uint64_t time_ns);

/// Joint angles as JointState: of position counts, with velocities in rad/s and efforts in N m if
/// there are any.
std::string joint_state(const Params& params, const std::int32_t (&position_count)[kMaxJoints],
                        std::span<const double> velocity_rad_s, std::span<const double> effort_n_m,
                        std::uint64_t time_ns);
/// One tick of the controller as JSON, by kControlSchema.
std::string control(const Params& params, const Inputs& inputs, const State& state,
                    const Outputs& outputs);
/// Gyro and accelerometer, rotated into the body frame; orientation is declared unknown.
std::string imu(const Params& params, const Inputs& inputs, std::uint64_t time_ns);
/// As transforms() names the frame of a node: body, or the joint that moves it.
std::string frame_of(const Params& params, int node);
/// world -> body, then one transform per joint: parent link to the link it moves, at the measured
/// angle.
std::string transforms(const Params& params, const Inputs& inputs, const BodyPose& body,
                       std::uint64_t time_ns);

std::string string(std::string_view text);
/// What string() was given; nothing if that is none.
std::optional<std::string> read_string(std::string_view message);

/// The body's pose in what transforms() made. None: it is no such message.
std::optional<BodyPose> body_pose(std::string_view transforms);

/// Angle of a joint from its raw count.
inline double joint_rad(const JointParams& joint, std::int32_t count) {
  if (joint.counts_per_rad == 0.0f) return 0;
  return (static_cast<double>(count) - static_cast<double>(joint.zero_count)) /
         static_cast<double>(joint.counts_per_rad);
}

}  // namespace verp::record::ros
