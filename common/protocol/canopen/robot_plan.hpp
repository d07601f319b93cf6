#pragma once
#include <cstdint>

#include "common/math/convert.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/drive_objects.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/pdo.hpp"

/// How one robot's nodes share a CAN bus. Node ids are those in Params, identifiers CiA 301's
/// predefined ones.
///
/// A tick is a round of SYNCs, 1 to sync_groups() (1019h). Drives answer in groups of five, in
/// joint order, the first group SYNC 1; IMU and feet answer the last. Goals, controlwords and
/// strengths of several drives share a frame: each drive maps its part, and dummies for the others.
namespace verp::canopen::plan {

/// The controller's node, which sends the heartbeat that drives watch.
inline constexpr std::uint8_t kControllerNode = 127;

/// Profile number in the low half of a drive's 1000h. A sensor's is 0.
inline constexpr std::uint16_t kDriveProfile = 402;
/// 1018h:2: a drive's ServoProfile::model_number (0 there: any), a sensor's dxl::kModelImu or
/// dxl::kModelFoot.
inline constexpr Address kDeviceType{0x1000, 0};
/// 0: this project has no vendor id. Manufacturer objects (2000h to 5FFFh) mean the following only
/// on nodes with vendor 0.
inline constexpr Address kVendor{0x1018, 1};
inline constexpr std::uint32_t kOurVendor = 0;
inline constexpr Address kProductCode{0x1018, 2};
inline constexpr Address kSyncOverflow{0x1019, 0};
inline constexpr Address kErrorBehaviour{0x1029, 1};

/// Our devices' own objects.
inline constexpr Address kTelemetry{0x2001, 0};                                ///< drives: u32
inline constexpr Address kGyro[3] = {{0x2010, 1}, {0x2010, 2}, {0x2010, 3}};   ///< IMU: i16
inline constexpr Address kAccel[3] = {{0x2011, 1}, {0x2011, 2}, {0x2011, 3}};  ///< IMU: i16
inline constexpr Address kFoot[kFootSensors] = {
    {0x2020, 1}, {0x2020, 2}, {0x2020, 3}, {0x2020, 4}};  ///< foot sensors: u16

struct Telemetry {
  std::uint16_t voltage_tenth_v = 0;
  std::uint8_t temperature_c = 0;
  std::uint8_t errors = 0;  ///< bits of dxl::HardwareError

  static constexpr Telemetry from(std::uint32_t value) {
    return {static_cast<std::uint16_t>(value), static_cast<std::uint8_t>(value >> 16),
            static_cast<std::uint8_t>(value >> 24)};
  }
  constexpr std::uint32_t value() const {
    return voltage_tenth_v | std::uint32_t{temperature_c} << 16 | std::uint32_t{errors} << 24;
  }
  constexpr bool operator==(const Telemetry&) const = default;
};

/// Ticks between asking one drive for velocity or torque.
inline constexpr std::uint8_t kEffortTicks = 4;

/// Most frames that answer one SYNC. An SJA1000 stores 64 bytes; a classic frame of eight takes
/// eleven.
inline constexpr int kAnswersToOneSync = 5;

constexpr int sensor_answers(const Params& params) {
  int frames = params.imu.device_id != 0 ? 2 : 0;
  for (const std::uint8_t id : params.feet.device_id) frames += id != 0 ? 1 : 0;
  return frames;
}
/// SYNCs of a tick, at least 2 (1019h has no 1); also all TPDOs' transmission type.
constexpr std::uint8_t sync_groups(const Params& params) {
  const int joints = params.servo_count();
  const int in_last = joints == 0 ? 0 : (joints - 1) % kAnswersToOneSync + 1;
  int groups = (joints + kAnswersToOneSync - 1) / kAnswersToOneSync;
  if (in_last + sensor_answers(params) > kAnswersToOneSync) ++groups;
  return static_cast<std::uint8_t>(groups < 2 ? 2 : groups);
}
/// SYNC start value of a drive's TPDO; a sensor's is sync_groups().
constexpr std::uint8_t group_of_joint(int joint) {
  return static_cast<std::uint8_t>(joint / kAnswersToOneSync + 1);
}

constexpr Mapped mapped(Address at, std::uint8_t bits) {
  return {at, bits};
}
/// TPDO 1 of a drive. Velocity or torque would load the bus of 21 drives to 73 % at 125 Hz, and
/// mappings cannot alternate: the controller asks for them by SDO, in turn.
constexpr PdoMapping<> drive_answer() {
  PdoMapping<> mapping;
  mapping.add(mapped(cia402::object::kStatusword, 16));
  mapping.add(mapped(cia402::object::kActualPosition, 32));
  return mapping;
}
inline constexpr std::uint8_t kDriveAnswerBytes = 6;
static_assert(drive_answer().bytes() == kDriveAnswerBytes);
/// TPDO 1 and 2 of an IMU.
constexpr PdoMapping<> imu_answer(const Address (&axes)[3]) {
  PdoMapping<> mapping;
  for (const Address& axis : axes) mapping.add(mapped(axis, 16));
  return mapping;
}
inline constexpr std::uint8_t kImuAnswerBytes = 6;
/// TPDO 1 of a foot.
constexpr PdoMapping<> foot_answer() {
  PdoMapping<> mapping;
  for (const Address& sensor : kFoot) mapping.add(mapped(sensor, 16));
  return mapping;
}
inline constexpr std::uint8_t kFootAnswerBytes = 8;

/// Several drives' data in one frame, event-driven (type 255): effective on arrival.
struct Shared {
  std::uint8_t rpdo = 1;   ///< PDO 1 to 3
  std::uint8_t width = 2;  ///< drives in one frame
  Mapped own;
  Mapped dummy;

  constexpr std::uint8_t bytes_each() const { return static_cast<std::uint8_t>(own.bits / 8); }
};
inline constexpr Shared kGoals{1, 2, {cia402::object::kTargetPosition, 32}, kDummyU32};
inline constexpr Shared kWords{2, 4, {cia402::object::kControlword, 16}, kDummyU16};
inline constexpr Shared kStrengths{3, 4, {cia402::object::kMaxTorque, 16}, kDummyU16};

/// Frame f has joints first_of() to first_of() + members - 1.
constexpr int shared_frames(const Shared& kind, const Params& params) {
  return (params.servo_count() + kind.width - 1) / kind.width;
}
constexpr int first_of(const Shared& kind, int frame) {
  return frame * kind.width;
}
constexpr int members_of(const Shared& kind, const Params& params, int frame) {
  const int left = params.servo_count() - first_of(kind, frame);
  return left < kind.width ? left : kind.width;
}
/// RPDO identifier of the frame's first drive.
constexpr std::uint16_t shared_id(const Shared& kind, const Params& params, int frame) {
  return rpdo_id(kind.rpdo, params.joint[first_of(kind, frame)].servo_id);
}
/// The RPDO of `joint`'s drive; its frame is joint / width.
constexpr PdoMapping<> shared_mapping(const Shared& kind, const Params& params, int joint) {
  const int frame = joint / kind.width;
  PdoMapping<> mapping;
  for (int i = 0; i < members_of(kind, params, frame); ++i) {
    mapping.add(first_of(kind, frame) + i == joint ? kind.own : kind.dummy);
  }
  return mapping;
}

/// Silence of the controller's heartbeat (1016h) after which a drive with torque stops and holds:
/// abort connection option (6007h) 3, quick stop option (605Ah) 6. Slightly more than the
/// controller waits before letting the robot down.
inline std::uint16_t patience_ms(const Params& params) {
  constexpr float kLater_s = 0.1F;
  constexpr std::int32_t kMost_ms = 60'000;
  const float release_s = params.tuning.safety.stale_release_s;
  const std::int32_t time_ms = math::to_int32((release_s + kLater_s) * 1000.0F);
  return static_cast<std::uint16_t>(time_ms < 1 ? 1 : time_ms > kMost_ms ? kMost_ms : time_ms);
}
inline constexpr std::int16_t kQuickStopAndHold = 6;
/// All but one of these heartbeats may be lost.
inline constexpr std::uint16_t kHeartbeatsInPatience = 5;
inline std::uint16_t heartbeat_ms(const Params& params) {
  return static_cast<std::uint16_t>(patience_ms(params) / kHeartbeatsInPatience);
}

/// SDO channels of the controller, besides the default one for anyone.
inline constexpr unsigned kWatcherSdo = 1;  ///< 1201h: follows the ticks
inline constexpr unsigned kToolSdo = 2;     ///< 1202h: `verp bus`
inline constexpr unsigned kControllerSdos = 2;
constexpr bool is_to_controllers_sdo(std::uint32_t id) {
  for (unsigned number = 1; number <= kControllerSdos; ++number) {
    if (id == further_sdo(number).request) return true;
  }
  return false;
}
constexpr bool is_of_controllers_sdo(std::uint32_t id) {
  for (unsigned number = 1; number <= kControllerSdos; ++number) {
    if (id == further_sdo(number).response) return true;
  }
  return false;
}

/// True for frames of a controller, or of a tool that asks nodes.
constexpr bool is_of_master(const Frame& frame) {
  if (!is_canopen(frame)) return false;
  const Connection from = connection_of(frame.id);
  const bool controller = from.node == kControllerNode;
  switch (from.service) {
    case Service::kNmt:
    case Service::kSync:
      return true;
    case Service::kRpdo:
    case Service::kSdoRequest:
      return !controller;
    case Service::kHeartbeat:
    case Service::kTpdo:
      return controller;
    default:
      return false;
  }
}
/// Silence that means no controller: slightly more than its heartbeat period.
inline std::uint32_t quiet_us(const Params& params) {
  return 1000u * heartbeat_ms(params) + 50'000;
}

}  // namespace verp::canopen::plan
