#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/io/io.hpp"
#include "common/math/linear.hpp"
#include "common/model/tuning.hpp"

/// The whole robot as constants, derived from the SDF entity on the host; firmware embeds the same
/// bytes (model/image.hpp). Fixed capacity.
///
/// Body frame: origin at the trunk's centre (not the CoM), x forward, y left, z up. At zero angles
/// every link frame is parallel to it, with its origin on the joint that moves the link.
namespace verp {

inline constexpr int kMaxNodes = kMaxJoints + 1;  ///< node 0 is the body; joint j moves node j + 1
inline constexpr int kLegJoints = 6;
inline constexpr std::uint8_t kNoJoint = 0xFF;  ///< an empty slot of a leg (model/leg.hpp)
inline constexpr int kNameLength = 24;

/// A rotation about a named axis costs 12 operations, others 45.
enum class AxisKind : std::uint8_t { kX, kY, kZ, kMinusX, kMinusY, kMinusZ, kGeneral };

/// Joints with a servo come first, parents before children; then followers (Params::followers),
/// anywhere in the tree.
struct JointParams {
  char name[kNameLength] = {};
  std::uint8_t parent = 0;  ///< node whose link carries this joint
  AxisKind axis_kind = AxisKind::kGeneral;
  std::uint8_t servo_id = 0;       ///< bus address; a follower has its driver's
  std::uint8_t servo_profile = 0;  ///< index into Params::servo
  Xyz origin_parent_m;             ///< joint position in the parent link's frame
  Xyz axis;                        ///< unit vector, right-hand rule
  float mass_kg = 0;               ///< of the link that this joint moves
  Xyz com_link_m;                  ///< centre of mass in the link frame
  float lower_rad = 0;
  float upper_rad = 0;
  float velocity_limit_rad_s = 0;  ///< limit by safety; at most the servo's no-load speed
  float counts_per_rad = 0;        ///< negative: servo mounted backwards
  float zero_count = 0;            ///< count at joint angle zero
  float compliance_rad_nm = 0;     ///< sag of the servo's position loop under load
  /// Inertia of rotor and gears at the joint (Gearbox, host/robot/model/entity.hpp).
  float armature_kg_m2 = 0;
  float friction_n_m = 0;          ///< friction torque near standstill
  float load_friction = 0;         ///< share of the load torque added to it
  float friction_speed_rad_s = 1;  ///< half of it is left at this speed
  /// Angle in standing and walking. Leg joints are solved; Newton starts here.
  float stand_rad = 0;
  float sit_rad = 0;  ///< crouch in which torque may be released
  VERP_FIELDS(name, parent, axis_kind, servo_id, servo_profile, origin_parent_m, axis, mass_kg,
              com_link_m, lower_rad, upper_rad, velocity_limit_rad_s, counts_per_rad, zero_count,
              compliance_rad_nm, armature_kg_m2, friction_n_m, load_friction, friction_speed_rad_s,
              stand_rad, sit_rad)
};
VERP_PACKED(JointParams);

enum class LegSolver : std::uint8_t { kNone = 0, kClosedForm = 1, kNewton = 2 };

/// One leg of six slots: yaw(z) roll(x) pitch(y) knee(y) ankle pitch(y) ankle roll(x). Closed form:
/// these canonical angles are all zero when the leg hangs straight down; joint angle = direction *
/// (canonical - offset). The foot frame is the last link's, origin at the ankle centre. The closed
/// form needs six joints, and feet that stand flat at zero. Newton does not: its first and last
/// slot may be empty, and its axes may be others.
struct LegParams {
  LegSolver solver = LegSolver::kNone;
  std::uint8_t joint[kLegJoints] = {};  ///< from hip to ankle, or kNoJoint
  std::uint8_t reserved = 0;
  float direction[kLegJoints] = {};  ///< +1 or -1
  float offset_rad[kLegJoints] = {};
  Xyz hip_body_m;     ///< intersection of the hip axes
  float thigh_m = 0;  ///< hip centre to knee axis, in the sagittal plane
  float shank_m = 0;  ///< knee axis to ankle centre
  Xyz sole_foot_m;    ///< sole frame's origin from the ankle centre
  float sole_foot[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< sole axes in the foot frame, row-major
  float sole_front_m = 0;  ///< sole's edges from its frame's origin, all positive
  float sole_back_m = 0;
  float sole_left_m = 0;
  float sole_right_m = 0;
  VERP_FIELDS(solver, joint, reserved, direction, offset_rad, hip_body_m, thigh_m, shank_m,
              sole_foot_m, sole_foot, sole_front_m, sole_back_m, sole_left_m, sole_right_m)
};
VERP_PACKED(LegParams);

/// Registers that the firmware writes to arm a servo, and bus features that the servo supports.
struct ServoProfile {
  /// Register 0: 1030 is XM430-W210, 30 is MX-28(2.0). On CAN, product code (1018h:2).
  std::uint16_t model_number = 0;
  std::uint16_t position_p_gain = 0;  ///< control table units
  std::uint16_t position_i_gain = 0;
  std::uint16_t position_d_gain = 0;
  std::uint16_t profile_ms = 0;      ///< time to the goal; 0: at once
  std::uint16_t fast_sync_read = 0;  ///< 1: answers instruction 0x8A
  VERP_FIELDS(model_number, position_p_gain, position_i_gain, position_d_gain, profile_ms,
              fast_sync_read)
};
VERP_PACKED(ServoProfile);
inline constexpr int kServoProfiles = 4;

struct ImuParams {
  float body_imu[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< IMU to body frame, row-major
  float gyro_rad_s_per_count = 0;
  float accel_m_s2_per_count = 0;
  std::uint8_t device_id = 0;  ///< address on the servo bus; 0: a chip on the board
  std::uint8_t reserved[3] = {};
  VERP_FIELDS(body_imu, gyro_rad_s_per_count, accel_m_s2_per_count, device_id, reserved)
};
VERP_PACKED(ImuParams);

struct FootSensorParams {
  std::uint8_t device_id[kFeet] = {};  ///< address on the servo bus; 0: none
  std::uint8_t reserved[2] = {};
  float newton_per_count = 0;
  VERP_FIELDS(device_id, reserved, newton_per_count)
};
VERP_PACKED(FootSensorParams);

enum class BusProtocol : std::uint8_t {
  kDynamixel2 = 0,  ///< serial, Dynamixel Protocol 2.0
  kCia402 = 1,      ///< CANopen, CiA 402; ids are node ids, 1 to 127
  kFeetech = 2,     ///< serial, Feetech STS
};

struct Params {
  char name[kNameLength] = {};
  std::uint32_t period_us = 10000;  ///< control period, 4000 to 20000
  std::uint32_t baud = 2000000;     ///< servo bus; on CAN the nominal bit rate
  std::uint8_t joint_count = 0;
  std::uint8_t head_pan = 0xFF;  ///< joint index, 0xFF: none
  std::uint8_t head_tilt = 0xFF;
  std::uint8_t rise_torque_percent = 100;  ///< of each servo's full duty, during the rise
  float body_mass_kg = 0;
  Xyz body_com_m;
  BusProtocol bus_protocol = BusProtocol::kDynamixel2;
  /// Number of joints at the end without an own servo (model/coupling.hpp): they share the motor of
  /// their servo_id.
  std::uint8_t followers = 0;
  std::uint8_t arm[kFeet] = {0xFF, 0xFF};  ///< joint that swings the arm fore and aft; 0xFF: none
  /// Angle of `arm` per metre of the left foot's lead that cancels the legs' spin about the
  /// vertical. 0 without an arm.
  float arm_rad_per_m[kFeet] = {};
  JointParams joint[kMaxJoints];
  LegParams leg[kFeet];
  ServoProfile servo[kServoProfiles];
  ImuParams imu;
  FootSensorParams feet;
  Tuning tuning;
  VERP_FIELDS(name, period_us, baud, joint_count, head_pan, head_tilt, rise_torque_percent,
              body_mass_kg, body_com_m, bus_protocol, followers, arm, arm_rad_per_m, joint, leg,
              servo, imu, feet, tuning)

  /// Joints with a servo of their own: the bus sees only these.
  constexpr std::uint8_t servo_count() const {
    return static_cast<std::uint8_t>(joint_count - followers);
  }
};
VERP_PACKED(Params);

}  // namespace verp
