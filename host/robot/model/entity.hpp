#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"

/// The robot on the PC, loaded and checked from an SDF file (load.hpp). Double precision, SI units.
/// Frames as in common/model/params.hpp; the body frame is at the trunk's centre. Every link frame
/// is parallel to the body frame at the zero pose. Its origin is on the joint that moves it (node
/// 0: the body frame itself). The file's fixed joints are already lumped into their links.
namespace verp::model {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Transform = Eigen::Isometry3d;

struct Collision {
  enum class Shape { kBox, kSphere, kCapsule, kCylinder } shape = Shape::kBox;
  Transform pose = Transform::Identity();  ///< in the link frame
  Vec3 size_m =
      Vec3::Zero();  ///< box: edges; sphere: x radius; capsule, cylinder: x radius, z length
  double friction = 1.0;
  double stiffness_n_m = 5e4;  ///< <ode><kp>
  double damping_n_s_m = 500;  ///< <ode><kd>
};

/// Appearance of a link; not used by physics.
struct Visual {
  enum class Shape { kBox, kSphere, kCapsule, kCylinder, kMesh } shape = Shape::kBox;
  Transform pose = Transform::Identity();  ///< in the link frame
  Vec3 size_m = Vec3::Zero();              ///< as Collision's; mesh: scale of each axis
  std::string name;
  std::string mesh;                          ///< file; empty: a file named by the robot is missing
  std::string mesh_uri;                      ///< as named in the robot's file
  std::optional<std::array<float, 4>> rgba;  ///< sRGB; none: not given
  std::optional<std::array<float, 3>> emissive_rgb;
  std::string texture;  ///< file of its albedo map; empty: none
};

struct Node {
  std::string name;  ///< link
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Zero();  ///< about the centre of mass, link axes
  std::vector<Collision> collisions;
  std::vector<Visual> visuals;
};

/// Gearbox between a motor and its joint, seen from the joint: the model of Duclusaud and Passault,
/// arXiv 2410.08650 (M4). The friction that may oppose motion is a budget,
///   f_base + s * f_strib + load * (l_base + s * l_strib) + f_visc * |speed|,
///   s = exp(-|speed / w_s|^alpha),
/// where load is the torque through the gears. The joint stands while the budget covers the
/// remaining torque.
struct Gearbox {
  double armature_kg_m2 = 0;  ///< rotor inertia times the gear ratio squared
  double f_base_n_m = 0, f_strib_n_m = 0;
  double l_base = 0, l_strib = 0;  ///< shares of the load
  double w_s_rad_s = 1, alpha = 1;
  double f_visc_n_m_s = 0;
};

/// A servo's datasheet values and its place on the bus.
struct Servo {
  std::string type;  ///< row of the servo table (servo_types.hpp), e.g. "xm430_w210"
  int id = 0;
  int direction = 1;
  int offset_count = 2048;
  double backlash_rad = 0;
  double stall_torque_n_m = 0;
  double no_load_speed_rad_s = 0;
  double stall_current_a = 0;
  double nominal_v = 12;  ///< supply voltage of the values above
  double counts_per_rev = 4096;
  double encoder_noise_deg = 0.03;  ///< rms
  double loop_s = 0.001;            ///< period of the firmware's position loop
  double loop_delay_s = 0;          ///< age of the angle that the loop uses
  double goal_delay_s = 0;          ///< from a goal's arrival until the servo acts on it
  Gearbox gearbox;
  /// The real values lie within these shares of the ones above: 0.5 means half to one and a half
  /// times. 0: identified on a bench.
  double armature_band = 0, friction_band = 0;
  std::string source;              ///< source of armature and friction: one line for people
  std::uint16_t model_number = 0;  ///< Params' ServoProfile says what it means on which bus
  bool fast_sync_read = false;
  std::uint16_t p_gain = 0, i_gain = 0, d_gain = 0;  ///< written at arming
  std::uint16_t profile_ms = 0;
};

/// joint[j] moves node[j + 1]. Followers of another joint's servo are last, as in Params.
struct Joint {
  std::string name;
  int parent = 0;                ///< node index
  Vec3 origin_m = Vec3::Zero();  ///< in the parent link's frame
  Vec3 axis = Vec3::UnitZ();     ///< body-aligned at zero pose
  double lower_rad = 0, upper_rad = 0;
  double velocity_limit_rad_s = 0;
  double friction_n_m = 0, damping_n_m_s = 0;
  double stand_rad = 0, sit_rad = 0;
  /// For a follower: its driver's servo.
  Servo servo;
  int follows = -1;  ///< index of the driver, whose servo moves this joint; -1: own servo
  double ratio = 1, offset_rad = 0;  ///< angle is ratio times the driver's, plus offset
};

struct Limb {
  std::string name;         ///< left_leg, right_leg, left_arm, right_arm, head
  std::vector<int> joints;  ///< from root to tip
  Transform tip =
      Transform::Identity();  ///< in the last link's frame; legs: the sole frame, x forward, z up
  Vec3 sole_min_m = Vec3::Zero(),
       sole_max_m = Vec3::Zero();  ///< legs: extent of the sole in the sole frame
};

struct ImuSensor {
  int node = 0;
  Transform pose = Transform::Identity();
  int id = 0;
  double gyro_rad_s_per_count = 0, accel_m_s2_per_count = 0;
  double gyro_noise_rad_s_rthz = 0, accel_noise_m_s2_rthz = 0;  ///< densities, per sqrt(Hz)
  double gyro_bias_rad_s = 0, accel_bias_m_s2 = 0;              ///< 1-sigma of the constant bias
  double latency_s = 0;                                         ///< age of its readings
};

struct FootSensor {
  std::array<int, 2> id{};  ///< left, right; 0: none
  double newton_per_count = 0;
};

/// A laser range finder that scans about its z axis; one sample: a single ray along x.
struct LaserSensor {
  std::string name;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
  double rate_hz = 10;
  int samples = 1;
  double first_rad = 0, last_rad = 0;
  double min_m = 0, max_m = 1, resolution_m = 0;
  double noise_mean_m = 0, noise_stddev_m = 0;  ///< per ray
  double latency_s = 0;                         ///< from the measurement until it is available

  double step_rad() const { return samples > 1 ? (last_rad - first_rad) / (samples - 1) : 0; }
  double angle_rad(int sample) const { return first_rad + sample * step_rad(); }
};

/// A camera looks along x; z is up in its picture. Direction (x, y, 1) in the lens axes (x right, y
/// down) maps to pixel (fx x' + cx, fy y' + cy). Pixel centres have whole numbers; (x', y') is (x,
/// y) after distortion.
struct CameraSensor {
  enum class Kind { kColour, kDepth, kColourAndDepth, kLabels };  ///< labels: of links and objects
  std::string name;
  Kind kind = Kind::kColour;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
  double rate_hz = 30;
  int width_px = 320, height_px = 240;
  double near_m = 0.02, far_m = 20;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  /// k1, k2, p1, p2, k3 of Brown and Conrady, in the order of OpenCV and ROS ("plumb_bob").
  std::array<double, 5> distortion{};
  double noise_mean = 0, noise_stddev = 0;  ///< per pixel: share of white; depth: m
  double latency_s = 0;                     ///< from the exposure until the picture is available

  bool has_colour() const { return kind == Kind::kColour || kind == Kind::kColourAndDepth; }
  bool has_depth() const { return kind == Kind::kDepth || kind == Kind::kColourAndDepth; }
  double horizontal_fov_rad() const { return 2 * std::atan(width_px / (2 * fx_px)); }
};

/// Force and torque between a link and its parent, at the sensor's origin and in its axes.
struct ForceTorqueSensor {
  std::string name, topic;
  int node = 0;                            ///< the sensor is on the joint that moves this node
  Transform pose = Transform::Identity();  ///< in that link's frame
  double rate_hz = 100, latency_s = 0;
  bool on_child = false;  ///< the load on the link; otherwise the load that it exerts
  Vec3 force_mean_n = Vec3::Zero(), force_stddev_n = Vec3::Zero();  ///< noise per axis
  Vec3 torque_mean_n_m = Vec3::Zero(), torque_stddev_n_m = Vec3::Zero();
};

/// Contacts of a link: partner, point and force.
struct ContactSensor {
  std::string name, topic;
  int node = 0;
  double rate_hz = 100, latency_s = 0;
};

/// True pose and motion of a point on a link; no real robot has this sensor.
struct TruthSensor {
  std::string name;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
  double rate_hz = 100, latency_s = 0;
  /// Noise per axis, standard deviation; 0: the truth.
  double position_noise_m = 0, angle_noise_rad = 0, velocity_noise_m_s = 0, rate_noise_rad_s = 0;
};

/// Any other sensor of the file: described and checked.
struct OtherSensor {
  std::string name, type, link;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
};

/// Two links that never collide, though they are not neighbours.
struct NoCollide {
  int link = 0, other = 0;  ///< nodes, link < other
  std::string reason;       ///< one line for people
};

/// Default share of the servos' torque for standing up, in percent.
inline constexpr std::uint8_t kRiseTorquePercent = 60;

struct Entity {
  std::string name;
  std::string file;
  std::vector<Node> nodes;
  std::vector<Joint> joints;
  std::vector<Limb> limbs;
  std::optional<ImuSensor> imu;
  FootSensor feet;
  std::vector<NoCollide> no_collide;
  std::vector<OtherSensor> sensors;
  std::vector<LaserSensor> lasers;  ///< this and the next three: also among the sensors
  std::vector<CameraSensor> cameras;
  std::vector<ForceTorqueSensor> force_torques;
  std::vector<ContactSensor> contacts;  ///< recorded ones
  std::vector<TruthSensor> truths;
  std::string bus;  ///< name of the bus in use
  std::string bus_file;
  int bus_line = 1;                ///< line of its <verp:bus> in bus_file
  std::vector<std::string> buses;  ///< names of all buses, in file order
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::uint32_t baud = 2000000;
  std::uint32_t period_us = 10000;
  std::uint8_t rise_torque_percent = kRiseTorquePercent;
  std::vector<std::pair<std::string, double>>
      tuning;  ///< overrides of Tuning's defaults: "gait.lift_m" -> value
  /// Values derived from legs, soles, mass and servos because the file omits them: one line each.
  std::vector<std::string> defaults;
  std::vector<std::string>
      notes;  ///< the file's declarations about third-party data: one line each, for people
};

inline double total_mass(const Entity& entity) {
  double sum = 0;
  for (const Node& node : entity.nodes) sum += node.mass_kg;
  return sum;
}

/// All joints, parents first.
inline std::vector<std::size_t> outward(const Entity& entity) {
  std::vector<std::size_t> order;
  std::vector<bool> placed(entity.nodes.size(), false);
  placed[0] = true;
  for (std::size_t before = 1; before != order.size() && order.size() < entity.joints.size();) {
    before = order.size();
    for (std::size_t j = 0; j < entity.joints.size(); ++j) {
      if (placed[j + 1] || !placed[static_cast<std::size_t>(entity.joints[j].parent)]) continue;
      placed[j + 1] = true;
      order.push_back(j);
    }
  }
  return order;
}

/// Value of protocol="..." in a file.
const char* protocol_name(BusProtocol protocol);

}  // namespace verp::model
