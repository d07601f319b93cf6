#pragma once
#include <cstddef>
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/numbers.hpp"
#include "common/model/params.hpp"
#include "common/model/tuning_ranges.hpp"

/// The controller as a Dynamixel device on the operator's port: the one source of the device
/// (firmware/app/operator_device.hpp), firmware/app/registers.md, the names in `verp bus` and an
/// object dictionary. Registers of every Dynamixel keep their addresses (0 to 7, 64, 68 to 70).
/// Little-endian, in order of address, each at a multiple of its size except Model Information.
namespace verp::dxl::controller {

inline constexpr std::uint8_t kDefaultId = 200;
inline constexpr std::uint16_t kModel = 0x7600;  ///< ours
/// Raise when a register moves or changes its meaning.
inline constexpr std::uint8_t kTableVersion = 1;

enum class Type : std::uint8_t { kU8, kU16, kU32, kU64, kI8, kI16, kI32, kF32, kText };
inline constexpr const char* kTypeNames[] = {"u8",  "u16", "u32", "u64", "i8",
                                             "i16", "i32", "f32", "text"};
constexpr std::uint8_t type_bytes(Type type) {
  constexpr std::uint8_t kBytes[] = {1, 2, 4, 8, 1, 2, 4, 4, 1};
  return kBytes[static_cast<std::size_t>(type)];
}
constexpr bool is_signed(Type type) {
  return type == Type::kI8 || type == Type::kI16 || type == Type::kI32;
}

enum class Access : std::uint8_t {
  kRead,      ///< written only by the controller
  kWrite,     ///< written at any time
  kDisarmed,  ///< written only while no servo holds torque
};
inline constexpr const char* kAccessNames[] = {"R", "RW", "RW disarmed"};

// In the order of the table's columns; it is constant.
struct Register {  // NOLINT(clang-analyzer-optin.performance.Padding)
  std::uint16_t address = 0;
  const char* name = "";
  Type type = Type::kU8;
  Access access = Access::kRead;
  std::uint16_t count = 1;    ///< elements, contiguous from `address`
  std::int32_t minimum = 0;   ///< of written values
  std::uint32_t maximum = 0;  ///< read as an int32 if `minimum` is negative
  const char* unit = "";
  const char* meaning = "";

  constexpr unsigned bytes() const { return unsigned{count} * type_bytes(type); }
  constexpr bool writable() const { return access != Access::kRead; }
  /// CANopen: a manufacturer object (2000h to 5FFFh). Several elements are an ARRAY, subindices
  /// from 1; a text is one VISIBLE_STRING.
  constexpr std::uint16_t object_index() const {
    return static_cast<std::uint16_t>(0x2000 + address);
  }
};

/// Rows of device arrays: servos as in Params, then these.
inline constexpr int kDeviceImu = kMaxJoints;
inline constexpr int kDeviceFoot = kDeviceImu + 1;  ///< left, then right
inline constexpr int kDeviceBus = kDeviceFoot + kFeet;
inline constexpr int kDeviceLink = kDeviceBus + 1;
inline constexpr int kDevices = 40;
static_assert(kDeviceLink < kDevices);

enum class DeviceKind : std::uint8_t { kNone, kServo, kImu, kFoot, kServoBus, kOperatorLink };
enum class DeviceState : std::uint8_t { kNeverSeen, kGood, kStale, kLost, kFaulty };
enum class HeadMode : std::uint8_t { kAngles = 0, kLookAt = 1 };
enum class ImuSource : std::uint8_t { kChip = 0, kBus = 1 };
enum class ImuCalibrationOrder : std::uint8_t { kNone = 0, kMeasure = 1, kForget = 2 };
enum class ImuCalibrationState : std::uint8_t {
  kNone,
  kMeasuring,
  kDone,
  kMoved,
  kNotUpright,
  kSilent,
  kDropped
};
/// control::BootVerdict, and kNotRun.
enum class SelfTest : std::uint8_t {
  kNotRun,
  kPassed,
  kContracted,
  kCode,
  kImage,
  kKinematics,
  kControl
};
/// As in hal/chip/stm32/reset_cause.hpp. kFault: a crash record.
enum class ResetCause : std::uint8_t {
  kUnknown,
  kPower,
  kPin,
  kSoftware,
  kWatchdog,
  kLowPower,
  kFault
};
/// As in hal/chip/stm32/brown_out.hpp.
enum class BrownOut : std::uint8_t { kUnknown, kKept, kWritten, kRefused };
/// As in hal/chip/stm32/clock.hpp. kUnknown: not reported.
enum class ClockSource : std::uint8_t { kUnknown, kCrystal, kInternalPll, kInternal, kAbsent };
/// Why a board never gives torque, and how often its LED flashes; one flash is the sign of life.
enum class StartFault : std::uint8_t {
  kNone,
  kSelfTest = 2,
  kTimer,
  kOperatorPort,
  kServoPort,
  kPeriod,
  kWatchdog,
  kProtocol  ///< the robot's protocol is not this image's
};
enum class ServoPower : std::uint8_t { kNotSwitched, kOn, kOff };
enum class WindowState : std::uint8_t { kIdle, kReceiving, kAccepted, kRefused };

inline constexpr std::uint16_t kWindowBytes = 128;

namespace row {
constexpr Register r(std::uint16_t address, const char* name, Type type, const char* unit,
                     const char* meaning, std::uint16_t count = 1) {
  return {address, name, type, Access::kRead, count, 0, 0, unit, meaning};
}
constexpr Register rw(std::uint16_t address, const char* name, Type type, std::uint32_t maximum,
                      const char* unit, const char* meaning, std::uint16_t count = 1) {
  return {address, name, type, Access::kWrite, count, 0, maximum, unit, meaning};
}
constexpr Register rw_i16(std::uint16_t address, const char* name, const char* unit,
                          const char* meaning) {
  return {address, name, Type::kI16, Access::kWrite, 1, -32768, 32767, unit, meaning};
}
constexpr Register disarmed(std::uint16_t address, const char* name, Type type,
                            std::uint32_t maximum, const char* unit, const char* meaning,
                            std::int32_t minimum = 0) {
  return {address, name, type, Access::kDisarmed, 1, minimum, maximum, unit, meaning};
}
inline constexpr Type u8 = Type::kU8, u16 = Type::kU16, u32 = Type::kU32, u64 = Type::kU64,
                      i16 = Type::kI16, i32 = Type::kI32, f32 = Type::kF32, text = Type::kText;
inline constexpr std::uint32_t kAll32 = 0xFFFFFFFFu;

// clang-format off
inline constexpr Register kTable[] = {
    // Identity.
    r(0, "model_number", u16, "", "30208 (7600h): a controller of this project"),
    r(2, "model_information", u32, "", "CRC-32 of the Params in force: names the robot"),
    r(6, "firmware_version", u8, "", "version of this table"),
    disarmed(7, "id", u8, 252, "", "Dynamixel id, kept without power; the reply to the write still bears the old one"),
    r(13, "protocol_type", u8, "", "2: Dynamixel Protocol 2.0"),
    r(14, "brown_out", u8, "", "reset below 2.7 V: 0 unknown (emulator), 1 the chip keeps it, 2 written at this start: reset, 1 must follow; 2 again or 3: refused, by readout protection of level 2 or worn flash; change the chip"),
    r(16, "core_version", u32, "", "same core version and Params: same outputs for same inputs"),
    r(20, "image_version", u32, "", "layout of the Params image that window_data takes"),
    r(24, "robot_name", text, "", "name of the robot in Params", kNameLength),
    r(48, "period_us", u32, "us", "control period: one tick"),
    r(52, "joint_count", u8, "", "joints in use; the joint arrays are longer"),
    r(53, "device_count", u8, "", "rows of the device arrays in use or kept free"),
    disarmed(54, "imu_source", u8, 1, "", "0 a chip on the board, 1 the IMU device on the servo bus; kept without power"),
    r(55, "imu_sources", u8, "bits", "sources this board has: bit 0 chip, bit 1 bus; others are refused"),
    r(56, "self_test", u8, "", "0 not run, 1 passed; failed: 2 arithmetic, 3 code, 4 Params image, 5 kinematics, 6 control"),
    r(57, "reset_cause", u8, "", "0 unknown, 1 power, 2 reset pin, 3 software, 4 watchdog, 5 low power, 6 fault"),
    r(58, "action_count", u16, "", "actions in the library"),
    r(60, "parameter_count", u16, "", "numbers that parameter_id names"),
    r(62, "clock_source", u8, "", "0 unknown, 1 crystal, 2 internal oscillator with PLL, 3 without, 4 none (emulator); 2, 3: no CAN"),
    disarmed(63, "torque_limit", u8, 100, "%", "of every servo's full strength, in every mode: for first steps; kept without power; 100 when new", 1),
    // Addresses common to all Dynamixels.
    r(64, "torque_enable", u8, "", "1 while any servo holds torque (\"armed\")"),
    r(65, "servo_power", u8, "", "0 this board does not switch it, 1 on, 2 off: emergency stop or start fault"),
    r(66, "joint_beyond", u8, "", "bus id of the joint for whose sake a robot was not let stand: it is beyond its limits, move it by hand; 255: none"),
    r(67, "action_fault", u8, "", "why the actions in flash do not count: 1 truncated, 2 no library, 3 of another version, 4 damaged, 5 out of bounds, 6 for another robot; 0: they do, or there are none"),
    rw(68, "status_return_level", u8, 2, "", "replies: 0 to ping, 1 to ping and reads, 2 to all"),
    r(69, "registered_instruction", u8, "", "1: a Reg Write waits for its Action"),
    r(70, "hardware_error", u8, "bits", "the low byte of faults, but for a quiet operator's; not 0: alert bit"),
    r(71, "start_fault", u8, "", "no torque until a reset; so many flashes: 2 self_test failed, 3 timer, 4 this port, 5 servo port, 6 period_us, 7 watchdog, 8 bus protocol; 0: none"),
    r(72, "crash_pc", u32, "", "the crash before this start: its instruction; 0 with crash_count 1 or more: stack overflow"),
    r(76, "crash_cause", u32, "bits", "CFSR of the core at that crash"),
    // The operator's order. A write to 80..101 makes it fresh and feeds the operator watchdog. With
    // torque off, request returns to 0 when a loop begins or stood still for longer than an order
    // lasts. After each start 1 to 3 are refused (Result Fail) until 0 was written: a repeated
    // order must not raise a robot that was reset.
    rw(80, "request", u8, 3, "", "0 relax, 1 stand, 2 walk, 3 stand, from the floor too: leave to get up by the robot's own action; after each start 1 to 3 are refused until 0 was written; with torque off back to 0 when a loop begins or stood still"),
    rw(81, "command_sequence", u8, 255, "", "count the orders here; it is recorded with each tick"),
    rw_i16(82, "walk_vx", "0.1 mm/s", "forward velocity, body frame"),
    rw_i16(84, "walk_vy", "0.1 mm/s", "velocity to the left, body frame"),
    rw_i16(86, "walk_wz", "mrad/s", "turn to the left"),
    rw_i16(88, "head_pan", "mrad", "to the left, with head_mode 0"),
    rw_i16(90, "head_tilt", "mrad", "down, with head_mode 0"),
    rw_i16(92, "look_x", "mm", "point to look at, forward, body frame, with head_mode 1"),
    rw_i16(94, "look_y", "mm", "point to look at, to the left"),
    rw_i16(96, "look_z", "mm", "point to look at, up"),
    rw(98, "head_mode", u8, 1, "", "0 head_pan and head_tilt, 1 the point look_x, look_y, look_z"),
    rw(99, "emergency_stop", u8, 1, "", "1: pressed; stays until written 0"),
    rw(100, "action_request", u16, 0xFFFF, "", "number of the action to play, up to action_count; plays once, from the stand and back to it; 0: none, also ends one"),
    disarmed(102, "imu_calibrate", u8, 2, "", "1: measure the chip's bias and mounting, robot upright and still; 2: forget them; reads as 0"),
    r(103, "imu_calibration", u8, "", "0 none, 1 measuring, 2 kept; refused, the old one counts: 3 moved, 4 not upright, 5 too few samples in 20 s (chip silent, or a twin in lockstep); 6 none counts: the kept one is of another scale or mounting"),
    r(104, "bring_up", u8, "", "0 not yet, 1 every device is ready; the last failure: 2 silent, 3 another model, 4 refused a write, 5 does not keep it, 6 has a hardware error, 7 somebody else commands nodes on its bus, 8 did not boot when it was reset"),
    r(105, "bring_up_device", u8, "", "bus id of the device at which it failed"),
    // A write of parameter_value reaches exactly one tick; until then another is refused (Result
    // Fail).
    rw(106, "parameter_id", u16, kTuningCount - 1, "", "which number; see the list below"),
    rw(108, "parameter_value", f32, kAll32, "", "its value in force; writing is refused out of its range"),
    r(112, "parameter_low", f32, "", "lowest value allowed"),
    r(116, "parameter_high", f32, "", "highest value allowed"),
    r(120, "crash_tick", u32, "ticks", "when it crashed, counted as tick"),
    r(124, "crash_count", u32, "", "crashes in a row before this start; 0: none is known"),
    r(128, "digest", u64, "", "chained digest of all ticks so far"),
    r(136, "tick", u32, "ticks", "control periods since power-up"),
    r(140, "faults", u32, "bits", "safety::Fault, latched until relaxed"),
    r(144, "mode", u8, "", "0 relaxed, 1 rising, 2 standing, 3 walking, 4 holding, 5 sitting, 6 fallen, 7 stopped, 8 acting, 9 falling, 10 getting up, 11 lying down"),
    r(145, "gait_phase", u8, "", "gait::Phase"),
    r(146, "gait_state", u8, "", "state within the cycle, 0 to 15"),
    r(147, "stance", u8, "", "foot that carries: 0 left, 1 right, 2 both"),
    r(148, "tilt_roll", i16, "0.1 mrad", "estimated roll of the body"),
    r(150, "tilt_pitch", i16, "0.1 mrad", "estimated pitch of the body, nose down positive"),
    r(152, "battery_voltage", u16, "0.1 V", "measured by the board; else the lowest supply of any servo; 0: not known"),
    r(154, "hottest_servo", u8, "", "id of the servo with the highest temperature"),
    r(155, "hottest_temperature", u8, "deg C", "its temperature; 0: none has told"),
    r(156, "gyro", i16, "counts", "x y z as read, IMU frame", 3),
    r(162, "accel", i16, "counts", "x y z as read, IMU frame, specific force", 3),
    r(168, "feet", u16, "counts", "left, then right: front-left, front-right, back-left, back-right", kFeet * kFootSensors),
    r(184, "joints_fresh", u32, "bits", "bit j: joint j was read in this tick"),
    r(188, "joints_torque", u32, "bits", "bit j: joint j holds its goal"),
    r(192, "command_age", u32, "ticks", "since the last order"),
    r(196, "bring_up_register", u16, "", "and its register or object; for 7 the identifier that was heard"),
    // Errors since power-up; all wrap.
    r(200, "bus_crc_errors", u32, "", "servo bus: packets with a wrong CRC"),
    r(204, "bus_timeouts", u32, "", "servo bus: requests that some device did not answer in time"),
    r(208, "bus_strays", u32, "", "servo bus: good packets nobody had asked for; several a tick: another master, or a transceiver that echoes what this board sends"),
    r(212, "bus_errors", u32, "", "servo bus: status packets with an error number"),
    r(216, "bus_refused", u32, "", "servo bus: frames the port did not take"),
    r(220, "overruns", u32, "", "ticks that followed one which ended after its deadline"),
    r(224, "skipped_periods", u32, "", "control periods that passed without a tick"),
    r(228, "imu_faults", u32, "", "times the IMU chip was silent, stuck or foreign"),
    r(232, "link_crc_errors", u32, "", "this link: packets with a wrong CRC"),
    r(236, "link_overruns", u32, "", "this link: times bytes were lost for coming too fast"),
    r(240, "link_framing", u32, "", "this link: bytes without a stop bit"),
    r(244, "link_noise", u32, "", "this link: bytes with noise or wrong parity"),
    r(248, "link_losses", u32, "", "this link: times it was lost"),
    r(252, "bus_noise", u32, "bytes", "servo bus: bytes that belonged to no whole packet"),
    // The joints, in the order of Params.
    r(256, "present_position", i32, "counts", "as last read from each servo", kMaxJoints),
    r(384, "goal_position", i32, "counts", "as last sent to each servo", kMaxJoints),
    r(512, "joint_id", u8, "", "bus id of each servo", kMaxJoints),
    r(544, "joint_temperature", u8, "deg C", "as each servo told last", kMaxJoints),
    r(576, "joint_error", u8, "bits", "Hardware Error Status as each servo told last", kMaxJoints),
    r(608, "joint_voltage", u16, "0.1 V", "as each servo told last", kMaxJoints),
    // Rows: 0..31 servos, 32 IMU, 33 and 34 feet, 35 servo bus, 36 this link.
    r(672, "device_kind", u8, "", "0 none, 1 servo, 2 IMU, 3 foot, 4 servo bus, 5 operator link", kDevices),
    r(712, "device_id", u8, "", "bus id; 0: has none", kDevices),
    r(752, "device_state", u8, "", "0 never seen, 1 good, 2 stale: silent, or a servo that tells the same position while its goal moves away, or an IMU that repeats itself, 3 lost, 4 reports a hardware error", kDevices),
    r(792, "device_rate", u16, "1/s", "reports in the last second (the link: packets)", kDevices),
    r(872, "device_age", u16, "ticks", "since the last report, up to 65535", kDevices),
    r(952, "device_errors", u32, "", "reports missed or stale; bus: CRC errors, timeouts, refused; link: CRC, overruns, framing, noise", kDevices),
    rw(1112, "window_kind", u8, 4, "", "what the window shows: 0 nothing, 1 the Params image, 2 actions; only to read: 3 the last tick, with tick_hold, 4 the last ticks; begins anew"),
    r(1113, "window_state", u8, "", "0 idle: while a block of actions is refused, their place is being made, so write it again; 1 receiving, 2 accepted: a board stores it and starts anew with it, 3 refused"),
    r(1114, "window_fault", u8, "", "why refused: of Params ImageFault, of actions as action_fault; 254: the flash did not keep a block, 255: the bytes do not have window_crc"),
    r(1116, "window_size", u32, "bytes", "of the image in force; 0: there are no actions"),
    rw(1120, "window_offset", u32, kAll32, "bytes", "where window_data[0] stands in the image"),
    rw(1124, "window_data", u8, 255, "", "reads show the image in force; writes go to a new one, of actions with torque off only", kWindowBytes),
    rw(1252, "window_crc", u32, kAll32, "", "CRC-32 (zip) of all bytes of the new image"),
    disarmed(1256, "window_commit", u8, 1, "", "1: check the new image and take it; reads as 0"),
    rw(1257, "tick_hold", u8, 2, "", "1: the State of the last tick stands still, to be read as an image, 2: the last ticks too; the loop goes on; refused where none are kept"),
    r(1258, "inputs_flags", u16, "bits", "of the last tick: InputFlag; on CAN also 256 IMU counts in parts, and from 4096 on the number of parts"),
    r(1260, "tick_low", u16, "ticks", "low half of tick"),
    r(1264, "inputs_part", u64, "", "on CAN: one part of the last tick's Inputs: half its offset, its size, up to 6 bytes"),
    r(1272, "joint_velocity", i32, "counts/s", "as each drive told last (606Ch); CiA 402 only", kMaxJoints),
    r(1400, "joint_torque", i16, "0.1 %", "of the rated torque, as each drive told last (6077h); CiA 402 only", kMaxJoints),
    r(1464, "image_field", text, "", "with self_test 4: the number in the Params image that is none, or none of a robot; empty: it is not that", kFieldNameLength),
    // common/balance/estimator.hpp: z up from the ground under the stance soles, x and y from
    // power-up, with odometry's drift.
    r(1504, "body_position", f32, "m", "estimated: origin of the body frame, x y z from where it was at power-up", 3),
    r(1516, "body_attitude", f32, "rad", "estimated: roll, pitch (nose down positive) and yaw (turned to the left since power-up)", 3),
    r(1528, "com_position", f32, "m", "estimated: centre of mass, x y z, as body_position", 3),
    r(1540, "com_velocity", f32, "m/s", "estimated: over the ground, along the axes of body_position", 3),
    r(1552, "dcm", f32, "m", "estimated: divergent component of motion on the ground, x y, as body_position", 2),
};
// clang-format on
}  // namespace row

inline constexpr const auto& kTable = row::kTable;
inline constexpr std::size_t kRegisters = sizeof(row::kTable) / sizeof(Register);
inline constexpr std::uint16_t kTableBytes =
    static_cast<std::uint16_t>(kTable[kRegisters - 1].address + kTable[kRegisters - 1].bytes());

constexpr bool same_name(const char* a, const char* b) {
  for (; *a == *b; ++a, ++b) {
    if (*a == '\0') return true;
  }
  return false;
}

/// Returns nullptr if there is none.
constexpr const Register* find(const char* name) {
  for (const Register& each : row::kTable) {
    if (same_name(each.name, name)) return &each;
  }
  return nullptr;
}

/// A register without texts, because flash is short.
struct Rule {
  std::uint16_t address = 0;
  std::uint8_t count = 0;
  std::uint8_t size : 4 = 0;  ///< one element's
  Access access : 2 = Access::kRead;
  bool is_text : 1 = false;
  std::int16_t minimum = 0;
  std::uint16_t most = 0;  ///< kAll: any value of the element

  static constexpr std::uint16_t kAll = 0xFFFF;
  constexpr std::int64_t maximum() const {
    if (minimum < 0) return std::int16_t(most);
    return size == 4 && most == kAll ? std::int64_t{0xFFFFFFFFu} : most;
  }
};
static_assert(sizeof(Rule) == 8);

struct Rules {
  Rule rule[kRegisters];
};
consteval Rules make_rules() {
  Rules rules{};
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const Register& from = row::kTable[i];
    Rule& rule = rules.rule[i];
    rule.address = from.address;
    rule.count = static_cast<std::uint8_t>(from.count);
    rule.size = type_bytes(from.type) & 0xF;
    rule.access = from.access;
    rule.is_text = from.type == Type::kText;
    rule.minimum = static_cast<std::int16_t>(from.minimum);
    rule.most = static_cast<std::uint16_t>(from.maximum);
  }
  return rules;
}
inline constexpr Rules kRules = make_rules();
consteval bool rules_hold_all() {
  for (std::size_t i = 0; i < kRegisters; ++i) {
    const Register& from = row::kTable[i];
    const Rule& rule = kRules.rule[i];
    const std::int64_t maximum = from.minimum < 0
                                     ? std::int64_t{static_cast<std::int32_t>(from.maximum)}
                                     : std::int64_t{from.maximum};
    if (rule.count != from.count || rule.size != type_bytes(from.type)) return false;
    if (rule.minimum != from.minimum || rule.maximum() != maximum) return false;
  }
  return true;
}
static_assert(rules_hold_all(), "a register is longer, or has other bounds, than Rule can say");

/// The element that begins at `address`; else nullptr.
constexpr const Rule* rule_at(std::uint16_t address) {
  std::size_t low = 0, high = kRegisters;  // the last at or before `address` is in [low, high)
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (kRules.rule[middle].address <= address ? low : high) = middle;
  }
  const Rule& rule = kRules.rule[low];
  const unsigned offset = unsigned{address} - rule.address;
  return offset < unsigned{rule.count} * rule.size && offset % rule.size == 0 ? &rule : nullptr;
}

consteval std::size_t longest_write() {
  std::size_t longest = 0, run = 0, end = 0;
  for (const Register& each : row::kTable) {
    run = each.writable() ? (each.address == end ? run : 0) + each.bytes() : 0;
    end = each.address + each.bytes();
    longest = run > longest ? run : longest;
  }
  return longest;
}

}  // namespace verp::dxl::controller
