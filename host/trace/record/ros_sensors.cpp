#include "host/trace/record/ros_sensors.hpp"

#include <algorithm>

#include "host/trace/record/cdr.hpp"
#include "host/trace/record/ros_header.hpp"

namespace verp::record::ros {
namespace {

#define VERP_ROS_BREAK \
  "================================================================================\n"
#define VERP_ROS_VECTOR \
  VERP_ROS_BREAK "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
#define VERP_ROS_WRENCH \
  VERP_ROS_BREAK        \
  "MSG: geometry_msgs/Wrench\ngeometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n"

/// ros_gz_interfaces/Entity: COLLISION.
constexpr std::uint8_t kEntityIsCollision = 5;

void put_entity(Cdr& out, std::string_view name) {
  out.put(std::uint64_t{0}).text(name).put(kEntityIsCollision);
}

}  // namespace

const MessageType kWrenchStamped = {
    "geometry_msgs/msg/WrenchStamped",
    "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n" VERP_ROS_HEADER VERP_ROS_WRENCH
        VERP_ROS_VECTOR};

const MessageType kContacts = {
    "ros_gz_interfaces/msg/Contacts",
    "std_msgs/Header header\nros_gz_interfaces/Contact[] contacts\n" VERP_ROS_HEADER VERP_ROS_BREAK
    "MSG: ros_gz_interfaces/Contact\n"
    "ros_gz_interfaces/Entity collision1\n"
    "ros_gz_interfaces/Entity collision2\n"
    "geometry_msgs/Vector3[] positions\n"
    "geometry_msgs/Vector3[] normals\n"
    "float64[] depths\n"
    "ros_gz_interfaces/JointWrench[] wrenches\n" VERP_ROS_BREAK
    "MSG: ros_gz_interfaces/Entity\n"
    "uint8 NONE=0\nuint8 LIGHT=1\nuint8 MODEL=2\nuint8 LINK=3\nuint8 VISUAL=4\n"
    "uint8 COLLISION=5\nuint8 SENSOR=6\nuint8 JOINT=7\n"
    "uint64 id\nstring name\nuint8 type\n" VERP_ROS_BREAK
    "MSG: ros_gz_interfaces/JointWrench\n"
    "std_msgs/Header header\n"
    "std_msgs/String body_1_name\n"
    "std_msgs/UInt32 body_1_id\n"
    "std_msgs/String body_2_name\n"
    "std_msgs/UInt32 body_2_id\n"
    "geometry_msgs/Wrench body_1_wrench\n"
    "geometry_msgs/Wrench body_2_wrench\n" VERP_ROS_BREAK
    "MSG: std_msgs/String\nstring data\n" VERP_ROS_BREAK
    "MSG: std_msgs/UInt32\nuint32 data\n" VERP_ROS_WRENCH VERP_ROS_VECTOR};

const MessageType kOdometry = {
    "nav_msgs/msg/Odometry",
    "std_msgs/Header header\n"
    "string child_frame_id\n"
    "geometry_msgs/PoseWithCovariance pose\n"
    "geometry_msgs/TwistWithCovariance twist\n" VERP_ROS_HEADER VERP_ROS_BREAK
    "MSG: geometry_msgs/PoseWithCovariance\n"
    "geometry_msgs/Pose pose\nfloat64[36] covariance\n" VERP_ROS_BREAK
    "MSG: geometry_msgs/Pose\n"
    "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n" VERP_ROS_BREAK
    "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n" VERP_ROS_BREAK
    "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n" VERP_ROS_BREAK
    "MSG: geometry_msgs/TwistWithCovariance\n"
    "geometry_msgs/Twist twist\nfloat64[36] covariance\n" VERP_ROS_BREAK
    "MSG: geometry_msgs/Twist\n"
    "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" VERP_ROS_VECTOR};

std::string wrench(const Wrench& wrench, std::string_view frame, std::uint64_t time_ns) {
  Cdr out;
  out.header(time_ns, frame).doubles(wrench.force_n).doubles(wrench.torque_n_m);
  return out.take();
}

std::string contacts(std::string_view link, const std::vector<ContactPoint>& points,
                     std::uint64_t time_ns) {
  std::vector<std::string_view> others;
  for (const ContactPoint& point : points) {
    if (std::find(others.begin(), others.end(), point.other) == others.end())
      others.push_back(point.other);
  }
  Cdr out;
  out.header(time_ns, "world").put(static_cast<std::uint32_t>(others.size()));
  for (const std::string_view other : others) {
    put_entity(out, link);
    put_entity(out, other);
    const auto count = static_cast<std::uint32_t>(std::count_if(
        points.begin(), points.end(), [&](const ContactPoint& p) { return p.other == other; }));
    out.put(count);
    for (const ContactPoint& point : points) {
      if (point.other == other) out.doubles(point.position_m);
    }
    out.put(std::uint32_t{0}).put(std::uint32_t{0}).put(count);  // normals, depths
    for (const ContactPoint& point : points) {
      if (point.other != other) continue;
      out.header(time_ns, "world").text(link).put(std::uint32_t{0});
      out.text(other).put(std::uint32_t{0});
      out.doubles(point.force_n).doubles(Three{});
      for (const double force_n : point.force_n) out.put(-force_n);
      out.doubles(Three{});
    }
  }
  return out.take();
}

std::string odometry(const Motion& motion, std::string_view frame, std::uint64_t time_ns,
                     std::string_view parent) {
  const auto covariance = [](double linear, double angular) {
    std::array<double, 36> out{};
    for (std::size_t i = 0; i < 6; ++i) out[7 * i] = i < 3 ? linear : angular;
    return out;
  };
  Cdr out;
  out.header(time_ns, parent).text(frame);
  out.doubles(motion.pose.position_m).doubles(motion.pose.orientation_xyzw);
  out.doubles(covariance(motion.position_m2, motion.angle_rad2));
  out.doubles(motion.velocity_m_s).doubles(motion.rate_rad_s);
  out.doubles(covariance(motion.velocity_m2_s2, motion.rate_rad2_s2));
  return out.take();
}

}  // namespace verp::record::ros
