#include "host/run/scenario/field_bugs.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/run/session/robot.hpp"

namespace verp::scenario {
namespace {

using session::Fault;
using session::WalkPlan;

enum LegJoint { kKnee = 3, kAnklePitch, kAnkleRoll };

JointParams& knee(Params& params, int foot = 0) {
  return params.joint[params.leg[foot].joint[kKnee]];
}
model::Joint& knee(WalkPlan& plan) {
  return plan.entity.joints[plan.params.leg[0].joint[kKnee]];
}
std::uint8_t ankle_roll(const Params& params) {
  const std::uint8_t joint = params.leg[0].joint[kAnkleRoll];
  if (joint == kNoJoint) throw ScenarioError("fault", "the robot has no ankle roll");
  return joint;
}
model::ImuSensor& imu(WalkPlan& plan) {
  if (!plan.entity.imu) throw ScenarioError("fault", "the robot has no IMU");
  return *plan.entity.imu;
}
void turn_imu(WalkPlan& plan, const model::Vec3& axis, double degrees) {
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, axis);
  imu(plan).pose.linear() *= turn.toRotationMatrix();
}

enum class Needs { kAnyBus, kSerial, kDynamixel };

void fault(WalkPlan& plan, Fault fault, Needs needs = Needs::kSerial) {
  const BusProtocol bus = plan.params.bus_protocol;
  if (needs == Needs::kDynamixel && bus != BusProtocol::kDynamixel2)
    throw ScenarioError("fault", "this bug needs a Dynamixel bus: choose it with --bus");
  if (needs == Needs::kSerial && bus == BusProtocol::kCia402)
    throw ScenarioError("fault", "this bug needs a serial servo bus: choose one with --bus");
  plan.fault = std::make_shared<const Fault>(std::move(fault));
}
void spoil(WalkPlan& plan, const bus::LineFaults& line, double at_s = kBegins_s) {
  fault(plan, {.at_s = at_s, .line = line});
}
void event(WalkPlan& plan, std::function<void(session::Robot&)> begin, double at_s = kBegins_s,
           Needs needs = Needs::kSerial) {
  fault(plan, {.at_s = at_s, .begin = std::move(begin)}, needs);
}
void each_tick(WalkPlan& plan, std::function<void(session::Robot&)> each,
               Needs needs = Needs::kSerial) {
  fault(plan, {.at_s = kBegins_s, .each_tick = std::move(each)}, needs);
}
void rewire(WalkPlan& plan, std::function<void(Params&)> devices) {
  fault(plan, {.devices = std::move(devices)});
}
/// A register of the left knee's servo, before the bring-up.
void write(WalkPlan& plan, std::uint16_t address, std::vector<std::uint8_t> data) {
  constexpr std::uint32_t kAnswers_us = 20'000;
  const auto begin = [id = knee(plan.params).servo_id, address, data](session::Robot& robot) {
    std::uint8_t frame[64];
    const std::size_t size =
        dxl::encode_write(frame, sizeof frame, id, address, data.data(), data.size());
    robot.bus().send(frame, size);
    robot.let_pass(kAnswers_us);
  };
  event(plan, begin, -1, Needs::kDynamixel);
}
void unplug(WalkPlan& plan, const std::vector<std::uint8_t>& ids, double at_s = kBegins_s) {
  const auto begin = [ids](session::Robot& robot) {
    for (const std::uint8_t id : ids) robot.bus().set_connected(id, false);
  };
  event(plan, begin, at_s);
}

void second_master(session::Robot& robot) {
  const Params& params = robot.plan().params;
  std::uint8_t frame[hal::kMaxFrame];
  dxl::Encoder encoder(frame, sizeof frame);
  dxl::begin_sync_write(encoder, dxl::address::kGoalPosition, 4);
  for (int j = 0; j < params.servo_count(); ++j) {
    encoder.u8(params.joint[j].servo_id);
    encoder.u32(2048);
  }
  robot.bus().send(frame, encoder.finish());
}
void flutter(session::Robot& robot) {
  const bool open = robot.twin().now_us() % 300'000 < 70'000;
  robot.bus().set_connected(robot.plan().params.joint[0].servo_id, !open);
}

void run_late(session::Robot& robot) {
  robot.let_pass(50'000);
}
void stand_still(session::Robot& robot) {
  robot.let_pass(1'000'000);
}

constexpr Injection at(const char* quantity) {
  return {.text = quantity};
}
constexpr Injection file(const char* part, const char* tag, const char* value) {
  return {.text = part, .tag = tag, .value = value};
}
constexpr Injection by(const char* words, void (*change)(WalkPlan&)) {
  return {.text = words, .change = change};
}

using enum BugFamily;
using enum Catcher;

/// The threads were read in November 2026.
const FieldBug kBugs[] = {
    // Bus and link
    {"status_lost", kBus, "Status packets get lost", "ROBOTIS-GIT/DynamixelSDK#84", kTable,
     "servo silent",
     by("bus: one byte in fifty is lost", [](WalkPlan& p) { spoil(p, {.lost = 0.02}); })},
    {"latency_16_ms", kBus, "The USB adapter keeps bytes for 16 ms, its default latency timer",
     "ROBOTIS-GIT/DynamixelSDK#330", kBringUp, "does not answer",
     by("bus: answers come 16 ms late", [](WalkPlan& p) { spoil(p, {.held_us = 16'000}, -1); })},
    {"noisy_cable", kBus, "A camera or motor disturbs the cable: packets arrive in pieces",
     "realsenseai/librealsense#3048", kTable, "servo silent",
     by("bus: noise in six of ten frames", [](WalkPlan& p) { spoil(p, {.bursts = 0.6}); })},
    {"duplicate_id", kBus, "Two servos have the same id", "ROBOTIS-GIT/DynamixelSDK#11", kBringUp,
     "does not answer",
     by("robot: the left knee has the right one's id",
        [](WalkPlan& p) { rewire(p, [](Params& d) { knee(d).servo_id = knee(d, 1).servo_id; }); })},
    {"factory_baud", kBus, "A new servo runs at its factory baud rate",
     "ROBOTIS-GIT/DynamixelSDK#64", kBringUp, "does not answer",
     by("servo: Baud Rate (8) of a knee is 1, 57600",
        [](WalkPlan& p) { write(p, dxl::address::kBaudRate, {1}); })},
    {"answers_off", kBus, "A servo's Status Return Level lets it answer to pings only", "",
     kBringUp, "does not answer",
     by("servo: Status Return Level (68) of a knee is 0",
        [](WalkPlan& p) { write(p, dxl::address::kStatusReturnLevel, {0}); })},
    {"never_plugged", kBus, "A servo's plug was forgotten after a repair",
     "CMU-Robotics-Club/RoboBuggy#317", kBringUp, "does not answer",
     by("bus: a knee is silent from the start",
        [](WalkPlan& p) { unplug(p, {knee(p.params).servo_id}, -1); })},
    {"leg_unplugged", kBus, "A leg's cable slips out during the walk",
     "robotology/mesh-support#1650", kTable, "servo silent",
     by("bus: the left leg's servos are silent",
        [](WalkPlan& p) {
          std::vector<std::uint8_t> ids;
          for (const std::uint8_t j : p.params.leg[0].joint) {
            if (j != kNoJoint) ids.push_back(p.params.joint[j].servo_id);
          }
          unplug(p, ids);
        })},
    {"usb_unplugged", kBus, "The USB adapter disconnects during the walk", "NUbots/NUbots#17",
     kTable, "servo silent",
     by("bus: all devices are silent",
        [](WalkPlan& p) {
          std::vector<std::uint8_t> ids;
          for (int id = 0; id <= dxl::kMaxId; ++id) ids.push_back(static_cast<std::uint8_t>(id));
          unplug(p, ids);
        })},
    {"loose_plug", kBus, "A plug is loose: its servo is silent again and again",
     "robotology/mesh-support#1766", kTable, "again and again",
     by("bus: a servo is silent for 70 ms in each 300",
        [](WalkPlan& p) { each_tick(p, flutter); })},
    {"two_masters", kBus, "A second program writes goals to the same bus",
     "ROBOTIS-GIT/turtlebot3_manipulation#95", kTable, "does not follow",
     by("bus: another master sends all servos to 2048",
        [](WalkPlan& p) { each_tick(p, second_master, Needs::kDynamixel); })},
    // Servos
    {"jammed_knee", kServo, "A gearbox jams", "robotology/mesh-support#2054", kTable,
     "does not follow", at("{knee}.friction_n_m=100")},
    {"stuck_encoder", kServo, "An encoder repeats one angle", "robotology/mesh-support#2026",
     kTable, "does not follow", at("{knee}.encoder_stuck=1")},
    {"count_jump", kServo, "An angle wraps by a turn during the walk", "huggingface/lerobot#1255",
     kTable, "does not follow", at("{knee}.encoder_off_count=4096")},
    {"offset_overflow", kServo, "A homing offset overflows: the angle is a turn off from the start",
     "huggingface/lerobot#1296", kTable, "beyond its limits",
     by("servo: a knee reads 4096 counts more",
        [](WalkPlan& p) {
          event(
              p,
              [](session::Robot& robot) {
                const int j = robot.plan().params.leg[0].joint[kKnee];
                robot.twin().servo(j).encoder_off_count = 4096;
              },
              -1);
        })},
    {"wrong_model", kServo, "A servo with another gear ratio was built in",
     "google-research/robel#4", kBringUp, "the model says",
     by("robot: a knee is an XM430-W350",
        [](WalkPlan& p) {
          rewire(p, [](Params& d) {
            d.servo[1] = d.servo[0];
            d.servo[1].model_number = dxl::kModelXm430W350;
            knee(d).servo_profile = 1;
          });
        })},
    {"gear_2_to_1", kServo, "A belt or pulley halves the angle, and the model does not know",
     "jsk-ros-pkg/jsk_aerial_robot#534", kTable, "beyond its limits",
     by("robot: a knee's servo turns twice as far",
        [](WalkPlan& p) { knee(p).servo.counts_per_rev *= 2; })},
    {"weak_limit", kServo, "A servo kept a low torque limit", "ROBOTIS-GIT/DynamixelSDK#588",
     kTable, "does not follow",
     by("servo: PWM Limit (36) of a knee is 100 of 885",
        [](WalkPlan& p) {
          write(p, dxl::address::kPwmLimit, {100, 0});
        })},
    {"weak_servo", kServo, "A worn servo has lost its strength", "robotology/mesh-support#1925",
     kTwin, "fell",
     by("robot: a knee has a fifth of its torque",
        [](WalkPlan& p) { knee(p).servo.stall_torque_n_m *= 0.2; })},
    {"hot_servo", kServo, "A servo gets too hot", "NVlabs/GR00T-WholeBodyControl#173", kTable,
     "too hot", at("{knee}.temperature_c=78")},
    {"built_in_backwards", kServo, "A servo turns the other way", "chvmp/champ#101", kTable,
     "beyond its limits",
     by("robot: a knee's servo turns backwards",
        [](WalkPlan& p) { knee(p).servo.direction *= -1; })},
    {"ankles_swapped", kServo, "Pitch and roll of an ankle have each other's id",
     "unitreerobotics/xr_teleoperate#320", kTable, "does not follow",
     by("robot: the left ankle's servos have each other's id",
        [](WalkPlan& p) {
          rewire(p, [](Params& d) {
            std::swap(d.joint[d.leg[0].joint[kAnklePitch]].servo_id,
                      d.joint[ankle_roll(d)].servo_id);
          });
        })},
    {"horn_15_degrees", kServo, "A horn was mounted teeth off", "mike4192/spotMicro#8", kTable,
     "does not follow",
     by("robot: a knee's zero is 15 degrees off",
        [](WalkPlan& p) { knee(p).servo.offset_count += 171; })},
    {"horn_7_degrees", kServo, "A horn was mounted one tooth off", "mike4192/spotMicro#43", kNobody,
     "the servo's own angle is right, and the soles yield: it walks on, a little askew",
     by("robot: an ankle roll's zero is 7 degrees off",
        [](WalkPlan& p) { p.entity.joints[ankle_roll(p.params)].servo.offset_count += 80; })},
    // IMU
    {"imu_5_degrees", kImu, "The IMU is askew on its bracket", "NASA-JSC-Robotics/valkyrie#37",
     kTwin, "askew",
     by("robot: the IMU is pitched by 5 degrees",
        [](WalkPlan& p) { turn_imu(p, model::Vec3::UnitY(), 5); })},
    {"imu_back_to_front", kImu, "The IMU's x axis points backwards", "upkie/upkie_description#2",
     kTwin, "fell",
     by("robot: the IMU is turned by 180 degrees about z",
        [](WalkPlan& p) { turn_imu(p, model::Vec3::UnitZ(), 180); })},
    {"imu_upside_down", kImu, "The IMU hangs upside down, or its z has the wrong sign",
     "leggedrobotics/grand_tour_box#475", kTwin, "by its IMU it lies",
     by("robot: the IMU is turned by 180 degrees about x",
        [](WalkPlan& p) { turn_imu(p, model::Vec3::UnitX(), 180); })},
    {"accel_in_g", kImu, "The accelerometer counts in g instead of m/s2", "finani/ICM42688#25",
     kTwin, "in g",
     by("robot: accelerations are 9.8 times smaller",
        [](WalkPlan& p) { imu(p).accel_m_s2_per_count *= 9.80665; })},
    {"gyro_in_degrees", kImu, "The gyro counts degrees instead of radians",
     "KumarRobotics/ublox#179", kTwin, "fell",
     by("robot: rates are 57 times larger",
        [](WalkPlan& p) { imu(p).gyro_rad_s_per_count *= std::numbers::pi / 180; })},
    {"imu_frozen", kImu, "The IMU repeats a reading, but for one bit",
     "robotology/mesh-support#585", kTable, "IMU silent", at("robot.imu_stuck=1")},
    {"imu_loose", kImu, "The IMU comes off and hangs on its cable", "utra-robosoccer/soccerbot#295",
     kTable, "IMU silent", at("robot.imu_loose=1")},
    {"imu_unplugged", kImu, "The IMU falls silent", "fsteinhardt/mpu6050_serial_to_imu#14", kTable,
     "IMU silent",
     by("bus: the IMU is silent", [](WalkPlan& p) { unplug(p, {p.params.imu.device_id}); })},
    {"imu_late", kImu, "A filter or driver delays the IMU",
     "stephane-caron/lipm_walking_controller#49", kNobody,
     "on a level floor the gait bears it; only a push would show it",
     by("robot: readings are 150 ms old", [](WalkPlan& p) { imu(p).latency_s = 0.15; })},
    // The model's file
    {"limits_in_degrees", kModel, "A joint's limits are in degrees", "kth-ros-pkg/yumi#10", kCheck,
     "no position limits", file("<joint name=\"{knee}\"", "<upper>", "*57.3")},
    {"pose_in_degrees", kModel, "A pose is in degrees", "fkanehiro/hrpsys-base#179", kCheck,
     "outside its limits", file("<verp:joint name=\"{knee}\"", "rad=\"", "*57.3")},
    {"mass_in_grams", kModel, "A mass is in grams", "ros-industrial/kuka_experimental#36", kCheck,
     "check the units", file("<link name=\"{trunk}\"", "<mass>", "*1000")},
    {"link_in_mm", kModel, "A link's length is in millimetres", "personalrobotics/or_urdf#6",
     kCheck, "check the units", file("<joint name=\"{knee}\"", "{thigh}\">", "*1000")},
    {"axis_sign", kModel, "A joint's axis has the wrong sign", "osrf/drcsim#68", kCheck,
     "tilts the sole", file("<joint name=\"{knee}\"", "<xyz>", "*-1")},
    {"legs_swapped", kModel, "Left and right leg are swapped",
     "HumaRobotics/phantomx_description#1", kCheck, "swap the two legs",
     file("<verp:limb name=\"left_leg\"", "tip=\"", "r_sole")},
    {"point_inertia", kModel, "A link has no inertia", "robotology/icub-models-generator#18",
     kCheck, "invalid inertia", file("<link name=\"{foot}\"", "<ixx>", "0")},
    {"narrow_limits", kModel, "A joint's limits are narrower than the robot's stand",
     "berkeleyopenarms/blue_core#65", kCheck, "outside its limits",
     file("<joint name=\"{knee}\"", "<upper>", "0.5")},
    {"sole_missing", kModel, "The foot's collision shape is not where the sole is",
     "Gepetto/example-robot-data#50", kCheck, "no box of the foot",
     file("<collision name=\"{foot}", "<pose>", "0 0 0 0 0 0")},
    // Power and people
    {"brown_out", kPower, "The supply breaks down under load", "ManufacturedMotion/Hex#126", kTable,
     "voltage low", at("robot.supply_v=9")},
    {"empty_battery", kPower, "The walk begins with an empty battery",
     "pollen-robotics/reachy_mini#1402", kTable, "voltage low",
     by("robot: the battery has 9.7 V", [](WalkPlan& p) { p.twin.supply_v = 9.7; })},
    {"wrong_supply", kPower, "The supply has more than the servos admit", "NUbots/NUbots#1163",
     kTable, "hardware error",
     by("robot: the supply has 17 V", [](WalkPlan& p) { p.twin.supply_v = 17; })},
    {"in_the_air", kPower, "It hangs in the air and walks", "gbionics/walking-controllers#148",
     kTable, "feet carry nothing",
     by("robot: a strap holds it 0.1 m above the floor",
        [](WalkPlan& p) {
          p.twin.cradle = sim::Cradle::kAlways;
          p.twin.start_m.z() = 0.1;
        })},
    {"operator_gone", kPower, "The gamepad loses its connection while it walks",
     "ros-drivers/joystick_drivers#92", kTable, "operator silent",
     by("operator: no order comes any more",
        [](WalkPlan& p) {
          fault(p, {.at_s = kBegins_s, .amend = [](app::OperatorOrder& order) { order.flags = 0; }},
                Needs::kAnyBus);
        })},
    {"late_process", kPower, "A busy PC runs each tick late", "airo-ugent/airo-mono#172", kTwin,
     "controller was late",
     by("controller: each tick takes 50 ms more",
        [](WalkPlan& p) { each_tick(p, run_late, Needs::kAnyBus); })},
    {"stalled", kPower, "The controller's process stands still for a second",
     "zauberzeug/rosys#301", kTable, "operator silent",
     by("controller: no tick for a second",
        [](WalkPlan& p) { event(p, stand_still, kBegins_s, Needs::kAnyBus); })},
    {"lies_already", kPower, "A walk is ordered while the robot lies",
     "Interbotix/HROS1-Framework#10", kTwin, "fell",
     by("robot: it lies on its back", [](WalkPlan& p) { p.twin.lies = sim::Lies::kBack; })},
};

}  // namespace

std::span<const FieldBug> field_bugs() {
  return kBugs;
}

}  // namespace verp::scenario
