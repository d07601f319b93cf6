#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/model/params.hpp"

/// The robot on the PC, from an SDF file (load.hpp). Double precision, SI units. Frames as in
/// common/model/params.hpp; the body frame is at the trunk's centre. Every link frame is parallel
/// to the body frame at the zero pose. Its origin is on the joint that moves it (node 0: the body
/// frame itself). Fixed joints are lumped into their links.
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

/// Appearance of a link, not its physics.
struct Visual {
  enum class Shape { kBox, kSphere, kCapsule, kCylinder, kMesh } shape = Shape::kBox;
  Transform pose = Transform::Identity();  ///< in the link frame
  Vec3 size_m = Vec3::Zero();              ///< as Collision's; mesh: scale per axis
  std::string name;
  std::string mesh;                          ///< file; empty: it is missing
  std::string mesh_uri;                      ///< as in the robot's file
  std::optional<std::array<float, 4>> rgba;  ///< sRGB; none: not given
  std::optional<std::array<float, 3>> emissive_rgb;
  std::string texture;  ///< albedo map; empty: none
};

struct Node {
  std::string name;  ///< link
  double mass_kg = 0;
  Vec3 com_m = Vec3::Zero();
  Mat3 inertia_kg_m2 = Mat3::Zero();  ///< about the centre of mass, link axes
  std::vector<Collision> collisions;
  std::vector<Visual> visuals;
};

/// Gearbox seen from the joint: Duclusaud and Passault, arXiv 2410.08650 (M1 to M6). Friction is a
/// budget, the most that opposes motion:
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
  /// Loads from both sides count apart: the shares above are the motor's.
  bool is_directional = false;
  double l_external = 0, l_external_strib = 0;
  double q_motor_per_n_m = 0,
         q_external_per_n_m = 0;  ///< of the weaker side's square, with Stribeck
};

/// Datasheet values and place on the bus.
struct Servo {
  std::string type;  ///< row of the servo table (servo_types.hpp)
  int id = 0;
  int direction = 1;
  int offset_count = 2048;
  double backlash_rad = 0;
  double stall_torque_n_m = 0;
  double peak_torque_n_m = 0;  ///< of the drive's current limit; 0: it has none below stall
  double no_load_speed_rad_s = 0;
  double stall_current_a = 0;
  double nominal_v = 12;  ///< supply of the values above
  double counts_per_rev = 4096;
  double encoder_noise_deg = 0.03;  ///< rms
  double loop_s = 0.001;            ///< period of the firmware's position loop
  double loop_delay_s = 0;          ///< age of the angle that the loop uses
  double goal_delay_s = 0;          ///< from a goal's arrival to the servo's action
  Gearbox gearbox;
  /// True values lie within these shares of the ones above: 0.5 means half to one and a half times.
  /// 0: identified on a bench.
  double armature_band = 0, friction_band = 0;
  std::string source;     ///< of armature and friction, one line
  std::string estimated;  ///< numbers that nobody gave, one line; empty: none beyond source
  std::string unread;     ///< numbers of its file that the twin has no use for, one line
  double heat_capacity_j_k = 74, heat_resistance_k_w = 13;  ///< housing; housing to air
  std::uint16_t model_number = 0;  ///< Params' ServoProfile gives its meaning
  bool fast_sync_read = false;
  std::uint16_t p_gain = 0, i_gain = 0, d_gain = 0;  ///< written at arming
  double p_gain_unit = 128;  ///< P gain of one 885th of full duty for each count of error
  int most_gain = 16383;     ///< of its registers
  std::uint16_t profile_ms = 0;

  /// The most that it holds.
  double most_torque_n_m() const {
    return peak_torque_n_m > 0 ? std::min(peak_torque_n_m, stall_torque_n_m) : stall_torque_n_m;
  }
};

/// joint[j] moves node[j + 1]. Followers are last, as in Params.
struct Joint {
  std::string name;
  int parent = 0;                ///< node index
  Vec3 origin_m = Vec3::Zero();  ///< parent link's frame
  Vec3 axis = Vec3::UnitZ();     ///< body-aligned at zero pose
  double lower_rad = 0, upper_rad = 0;
  double velocity_limit_rad_s = 0;
  double friction_n_m = 0, damping_n_m_s = 0;
  double stand_rad = 0, sit_rad = 0;
  /// A follower has its driver's servo here.
  Servo servo;
  int follows = -1;                  ///< driver's index; -1: own servo
  double ratio = 1, offset_rad = 0;  ///< angle = ratio * driver's + offset
};

struct Limb {
  std::string name;                       ///< left_leg, right_leg, left_arm, right_arm, head
  std::vector<int> joints;                ///< from root to tip
  Transform tip = Transform::Identity();  ///< last link's frame; legs: the sole, x forward, z up
  Vec3 sole_min_m = Vec3::Zero(),
       sole_max_m = Vec3::Zero();  ///< extent of the sole, in its frame
};

struct ImuSensor {
  int node = 0;
  Transform pose = Transform::Identity();
  int id = 0;
  double gyro_rad_s_per_count = 0, accel_m_s2_per_count = 0;
  double gyro_noise_rad_s_rthz = 0, accel_noise_m_s2_rthz = 0;  ///< densities, per sqrt(Hz)
  double gyro_bias_rad_s = 0, accel_bias_m_s2 = 0;              ///< constant bias, 1 sigma
  double latency_s = 0;                                         ///< age of its readings
};

struct FootSensor {
  std::array<int, 2> id{};  ///< left, right; 0: none
  double newton_per_count = 0;
};

/// Scans about its z axis; one sample: a ray along x.
struct LaserSensor {
  std::string name;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
  double rate_hz = 10;
  int samples = 1;
  double first_rad = 0, last_rad = 0;
  double min_m = 0, max_m = 1, resolution_m = 0;
  double noise_mean_m = 0, noise_stddev_m = 0;  ///< per ray
  double latency_s = 0;                         ///< until the reading is available

  double step_rad() const { return samples > 1 ? (last_rad - first_rad) / (samples - 1) : 0; }
  double angle_rad(int sample) const { return first_rad + sample * step_rad(); }
};

/// Looks along x; z is up. (x, y, 1) in lens axes (x right, y down) maps to pixel (fx x' + cx, fy
/// y' + cy), with (x', y') after distortion. Pixel centres have whole numbers.
struct CameraSensor {
  enum class Kind { kColour, kDepth, kColourAndDepth, kLabels };  ///< labels: links and objects
  std::string name;
  Kind kind = Kind::kColour;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
  double rate_hz = 30;
  int width_px = 320, height_px = 240;
  double near_m = 0.02, far_m = 20;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0;
  /// Brown and Conrady's, in OpenCV's and ROS's order ("plumb_bob").
  std::array<double, 5> distortion{};
  double noise_mean = 0, noise_stddev = 0;  ///< per pixel; colour: share of white; depth: m
  double latency_s = 0;                     ///< from exposure to picture

  bool has_colour() const { return kind == Kind::kColour || kind == Kind::kColourAndDepth; }
  bool has_depth() const { return kind == Kind::kDepth || kind == Kind::kColourAndDepth; }
  double horizontal_fov_rad() const { return 2 * std::atan(width_px / (2 * fx_px)); }
};

/// Force and torque between a link and its parent, about the sensor's origin, in its axes.
struct ForceTorqueSensor {
  std::string name, topic;
  int node = 0;                            ///< the sensor is on the joint of this node
  Transform pose = Transform::Identity();  ///< in that link's frame
  double rate_hz = 100, latency_s = 0;
  bool on_child = false;  ///< the load on the link; else the one that it exerts
  Vec3 force_mean_n = Vec3::Zero(), force_stddev_n = Vec3::Zero();  ///< noise per axis
  Vec3 torque_mean_n_m = Vec3::Zero(), torque_stddev_n_m = Vec3::Zero();
};

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
  /// Standard deviation per axis; 0: the truth.
  double position_noise_m = 0, angle_noise_rad = 0, velocity_noise_m_s = 0, rate_noise_rad_s = 0;
};

/// Any other sensor: described and checked only.
struct OtherSensor {
  std::string name, type, link;
  int node = 0;
  Transform pose = Transform::Identity();  ///< in the link frame
};

/// Links that never collide, although not neighbours.
struct NoCollide {
  int link = 0, other = 0;  ///< nodes, link < other
  std::string reason;       ///< one line for people
};

/// What the file says of the battery and its cables; supply.hpp has the rest.
struct Supply {
  std::optional<double> volts, resistance_ohm;  ///< unloaded
};

/// Whose friction a joint has: the servo type's, its own in the file, or their sum.
enum class FrictionFrom { kServo, kFile, kBoth };

/// Share of the servos' torque for standing up, percent.
inline constexpr std::uint8_t kRiseTorquePercent = 60;

struct Entity {
  std::string name;
  std::string file;
  std::vector<Node> nodes;
  std::vector<Joint> joints;
  std::vector<Limb> limbs;
  std::optional<ImuSensor> imu;
  FootSensor feet;
  Supply supply;
  std::vector<NoCollide> no_collide;
  std::vector<OtherSensor> sensors;
  std::vector<LaserSensor> lasers;  ///< as the next three, also among the sensors
  std::vector<CameraSensor> cameras;
  std::vector<ForceTorqueSensor> force_torques;
  std::vector<ContactSensor> contacts;  ///< recorded ones
  std::vector<TruthSensor> truths;
  std::string bus;  ///< name of the bus in use
  std::string bus_file;
  int bus_line = 1;                ///< its line in bus_file
  std::vector<std::string> buses;  ///< in file order
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::uint32_t baud = 2000000;
  std::uint32_t period_us = 10000;
  std::uint8_t rise_torque_percent = kRiseTorquePercent;
  std::vector<std::pair<std::string, double>> tuning;  ///< "gait.lift_m" -> value
  /// Derived values that the file omits, one line each.
  std::vector<std::string> defaults;
  std::vector<std::string> notes;  ///< declarations about third-party data, one line each
};

inline constexpr double kGravity_m_s2 = 9.80665;  ///< standard (CGPM 1901)

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

const char* protocol_name(BusProtocol protocol);

}  // namespace verp::model
