#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/dictionary.hpp"

/// A CiA 402 drive in cyclic synchronous position mode: the one source of a virtual drive's
/// dictionary, a master's mapping and a description for tools. Units: encoder increments (608Fh a
/// turn), increments per second, thousandths of the rated torque (6076h).
namespace verp::canopen::cia402 {

/// Modes of operation (6060h) in use.
inline constexpr std::int8_t kModeNone = 0;
inline constexpr std::int8_t kModeCyclicPosition = 8;
/// Supported drive modes (6502h): bit n - 1 for mode n.
inline constexpr std::uint32_t kSupportedCyclicPosition = 1u << (kModeCyclicPosition - 1);

namespace object {
inline constexpr Address kErrorRegister{0x1001, 0};
inline constexpr Address kConsumerHeartbeat{0x1016, 1};
inline constexpr Address kProducerHeartbeat{0x1017, 0};
inline constexpr Address kAbortConnection{0x6007, 0};
inline constexpr Address kErrorCode{0x603F, 0};
inline constexpr Address kControlword{0x6040, 0};
inline constexpr Address kStatusword{0x6041, 0};
inline constexpr Address kQuickStopOption{0x605A, 0};
inline constexpr Address kMode{0x6060, 0};
inline constexpr Address kModeDisplay{0x6061, 0};
inline constexpr Address kActualPosition{0x6064, 0};
inline constexpr Address kFollowingWindow{0x6065, 0};
inline constexpr Address kFollowingTime{0x6066, 0};
inline constexpr Address kActualVelocity{0x606C, 0};
inline constexpr Address kMaxTorque{0x6072, 0};
inline constexpr Address kRatedCurrent{0x6075, 0};
inline constexpr Address kRatedTorque{0x6076, 0};
inline constexpr Address kActualTorque{0x6077, 0};
inline constexpr Address kDcLinkVoltage{0x6079, 0};
inline constexpr Address kTargetPosition{0x607A, 0};
inline constexpr Address kHomeOffset{0x607C, 0};
inline constexpr Address kMinPosition{0x607D, 1};
inline constexpr Address kMaxPosition{0x607D, 2};
inline constexpr Address kEncoderIncrements{0x608F, 1};
inline constexpr Address kEncoderTurns{0x608F, 2};
inline constexpr Address kPeriodValue{0x60C2, 1};
inline constexpr Address kPeriodExponent{0x60C2, 2};
inline constexpr Address kSupportedModes{0x6502, 0};
}  // namespace object

/// Defaults are CiA 402's.
struct DriveObjects {
  std::int32_t target_position = 0;
  std::int32_t actual_position = 0;
  std::int32_t actual_velocity = 0;
  std::int32_t home_offset = 0;  ///< encoder position of the application's zero
  std::int32_t min_position = INT32_MIN;
  std::int32_t max_position = INT32_MAX;
  std::uint32_t following_window = UINT32_MAX;  ///< UINT32_MAX: no check
  std::uint32_t supported_modes = kSupportedCyclicPosition;
  std::uint32_t dc_link_mv = 0;
  std::uint32_t rated_current_ma = 0;
  std::uint32_t rated_torque_mn_m = 0;
  std::uint32_t encoder_increments = 0;  ///< per encoder_turns turns of the joint
  std::uint32_t encoder_turns = 1;
  std::uint16_t controlword = 0;
  std::uint16_t statusword = 0;
  std::uint16_t error_code = 0;
  std::uint16_t following_time_ms = 0;
  std::uint16_t max_torque = 1000;
  std::int16_t actual_torque = 0;
  std::int16_t abort_connection = 1;
  std::int16_t quick_stop_option = 2;
  std::int8_t mode = kModeNone;
  std::int8_t mode_display = kModeNone;
  std::uint8_t period_value = 1;
  std::int8_t period_exponent = -3;
};

enum class ObjectAccess : std::uint8_t { kRead, kWrite };
enum class ObjectMapping : std::uint8_t { kNone, kReceive, kTransmit, kBoth };

struct ObjectRow {
  Address at;
  const char* name;
  std::uint8_t bytes;
  bool is_signed;
  ObjectAccess access;
  ObjectMapping mapping;
  std::uint16_t place;  ///< offset of the value in DriveObjects
};

extern const ObjectRow kDriveRows[];
extern const std::size_t kDriveRowCount;

/// Null if there is none; subindex 0 of several is no row.
const ObjectRow* find_row(Address at);
/// Subindex 0: the number of subindices of an object with several, else 0.
std::uint8_t highest_subindex(std::uint16_t index);

Abort find_object(Address at, Entry& entry);
Abort read_object(const DriveObjects& objects, Address at, std::uint8_t* buffer);
/// Refuses an unsupported mode, a period of 0, unknown option codes.
Abort write_object(DriveObjects& objects, Address at, const std::uint8_t* data);
/// kNone if a PDO may map the object with that length.
Abort check_mappable(Address at, std::uint8_t bits, bool receive);

/// 60C2h: value times ten to the exponent seconds. 0 if invalid or over a minute.
std::uint32_t interpolation_period_us(std::uint8_t value, std::int8_t exponent);

/// Following error: the distance of target and actual position (6065h, 6066h).
class FollowingMonitor {
 public:
  /// Call each cycle while following. True after too long outside the window.
  bool update(const DriveObjects& objects, std::uint64_t now_us);
  void reset() { outside_ = false; }

 private:
  bool outside_ = false;
  std::uint64_t since_us_ = 0;
};

}  // namespace verp::canopen::cia402
