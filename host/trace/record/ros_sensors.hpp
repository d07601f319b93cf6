#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/ros_messages.hpp"

namespace verp::record::ros {

extern const MessageType kWrenchStamped;  ///< geometry_msgs/msg/WrenchStamped
extern const MessageType kContacts;       ///< ros_gz_interfaces/msg/Contacts
extern const MessageType kOdometry;       ///< nav_msgs/msg/Odometry

using Three = std::array<double, 3>;

struct Wrench {
  Three force_n{}, torque_n_m{};
};
std::string wrench(const Wrench& wrench, std::string_view frame, std::uint64_t time_ns);

/// A contact point in the world frame.
struct ContactPoint {
  std::string other;
  Three position_m{}, force_n{};  ///< force on the link
};
/// One contact per object, whose points are consecutive. Normals and depths are not measured:
/// empty.
std::string contacts(std::string_view link, const std::vector<ContactPoint>& points,
                     std::uint64_t time_ns);

struct Motion {
  BodyPose pose;                       ///< in the world
  Three velocity_m_s{}, rate_rad_s{};  ///< body axes
  /// Variance of each axis.
  double position_m2 = 0, angle_rad2 = 0, velocity_m2_s2 = 0, rate_rad2_s2 = 0;
};
std::string odometry(const Motion& motion, std::string_view frame, std::uint64_t time_ns,
                     std::string_view parent = "world");
/// Estimated body pose, frame "odom" (common/balance/estimator.hpp). Variances are unknown.
std::string estimated_odometry(const Params& params, const Inputs& inputs, const State& state,
                               std::uint64_t time_ns);

}  // namespace verp::record::ros
