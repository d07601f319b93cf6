#include "common/protocol/canopen/drive_objects.hpp"

#include <type_traits>

#include "common/protocol/canopen/frame.hpp"

namespace verp::canopen::cia402 {
namespace {

using enum ObjectAccess;
constexpr ObjectMapping kOff = ObjectMapping::kNone;
constexpr ObjectMapping kTx = ObjectMapping::kTransmit;
constexpr ObjectMapping kRxTx = ObjectMapping::kBoth;

static_assert(std::is_standard_layout_v<DriveObjects> &&
              std::is_trivially_copyable_v<DriveObjects>);

#define VERP_ROW(at, name, member, access, mapping)                                           \
  ObjectRow {                                                                                 \
    at, name, sizeof(DriveObjects::member), std::is_signed_v<decltype(DriveObjects::member)>, \
        access, mapping, offsetof(DriveObjects, member)                                       \
  }

const std::uint8_t* bytes_of(const DriveObjects& objects, const ObjectRow& row) {
  return reinterpret_cast<const std::uint8_t*>(&objects) + row.place;
}

}  // namespace

constexpr ObjectRow kDriveRows[] = {
    VERP_ROW(object::kAbortConnection, "Abort connection option code", abort_connection, kWrite,
             kOff),
    VERP_ROW(object::kErrorCode, "Error code", error_code, kRead, kTx),
    VERP_ROW(object::kControlword, "Controlword", controlword, kWrite, kRxTx),
    VERP_ROW(object::kStatusword, "Statusword", statusword, kRead, kTx),
    VERP_ROW(object::kQuickStopOption, "Quick stop option code", quick_stop_option, kWrite, kOff),
    VERP_ROW(object::kMode, "Modes of operation", mode, kWrite, kRxTx),
    VERP_ROW(object::kModeDisplay, "Modes of operation display", mode_display, kRead, kTx),
    VERP_ROW(object::kActualPosition, "Position actual value", actual_position, kRead, kTx),
    VERP_ROW(object::kFollowingWindow, "Following error window", following_window, kWrite, kOff),
    VERP_ROW(object::kFollowingTime, "Following error time out", following_time_ms, kWrite, kOff),
    VERP_ROW(object::kActualVelocity, "Velocity actual value", actual_velocity, kRead, kTx),
    VERP_ROW(object::kMaxTorque, "Max torque", max_torque, kWrite, kRxTx),
    VERP_ROW(object::kRatedCurrent, "Motor rated current", rated_current_ma, kRead, kOff),
    VERP_ROW(object::kRatedTorque, "Motor rated torque", rated_torque_mn_m, kRead, kOff),
    VERP_ROW(object::kActualTorque, "Torque actual value", actual_torque, kRead, kTx),
    VERP_ROW(object::kDcLinkVoltage, "DC link circuit voltage", dc_link_mv, kRead, kTx),
    VERP_ROW(object::kTargetPosition, "Target position", target_position, kWrite, kRxTx),
    VERP_ROW(object::kHomeOffset, "Home offset", home_offset, kWrite, kOff),
    VERP_ROW(object::kMinPosition, "Min position limit", min_position, kWrite, kOff),
    VERP_ROW(object::kMaxPosition, "Max position limit", max_position, kWrite, kOff),
    VERP_ROW(object::kEncoderIncrements, "Encoder increments", encoder_increments, kRead, kOff),
    VERP_ROW(object::kEncoderTurns, "Motor revolutions", encoder_turns, kRead, kOff),
    VERP_ROW(object::kPeriodValue, "Interpolation time period value", period_value, kWrite, kOff),
    VERP_ROW(object::kPeriodExponent, "Interpolation time index", period_exponent, kWrite, kOff),
    VERP_ROW(object::kSupportedModes, "Supported drive modes", supported_modes, kRead, kOff),
};
const std::size_t kDriveRowCount = sizeof kDriveRows / sizeof kDriveRows[0];

const ObjectRow* find_row(Address at) {
  for (const ObjectRow& row : kDriveRows) {
    if (row.at == at) return &row;
  }
  return nullptr;
}

std::uint8_t highest_subindex(std::uint16_t index) {
  std::uint8_t highest = 0;
  for (const ObjectRow& row : kDriveRows) {
    if (row.at.index == index && row.at.subindex > highest) highest = row.at.subindex;
  }
  return highest;
}

Abort find_object(Address at, Entry& entry) {
  if (const ObjectRow* row = find_row(at); row != nullptr) {
    entry = {true, row->access == kWrite, row->bytes, row->bytes, row->bytes};
    return Abort::kNone;
  }
  if (at.subindex == 0 && highest_subindex(at.index) != 0) {
    entry = {true, false, 1, 1, 1};
    return Abort::kNone;
  }
  const bool object = find_row({at.index, 0}) != nullptr || highest_subindex(at.index) != 0;
  return object ? Abort::kNoSubindex : Abort::kNoObject;
}

Abort read_object(const DriveObjects& objects, Address at, std::uint8_t* buffer) {
  Entry entry;
  if (const Abort refused = find_object(at, entry); refused != Abort::kNone) return refused;
  const ObjectRow* row = find_row(at);
  if (row == nullptr) {
    buffer[0] = highest_subindex(at.index);
    return Abort::kNone;
  }
  for (unsigned i = 0; i < row->bytes; ++i) buffer[i] = bytes_of(objects, *row)[i];
  return Abort::kNone;
}

Abort write_object(DriveObjects& objects, Address at, const std::uint8_t* data) {
  Entry entry;
  if (const Abort refused = find_object(at, entry); refused != Abort::kNone) return refused;
  if (!entry.writable) return Abort::kReadOnly;
  const ObjectRow* row = find_row(at);
  DriveObjects changed = objects;
  auto* to = reinterpret_cast<std::uint8_t*>(&changed) + row->place;
  for (unsigned i = 0; i < row->bytes; ++i) to[i] = data[i];
  const bool known_mode = changed.mode == kModeNone || changed.mode == kModeCyclicPosition;
  if (at == object::kMode && !known_mode) return Abort::kValueRange;
  const std::int16_t lost = changed.abort_connection;
  if (at == object::kAbortConnection && (lost < 0 || lost > 3)) return Abort::kValueRange;
  const std::int16_t stop = changed.quick_stop_option;
  if (at == object::kQuickStopOption && (stop < 0 || stop > 8 || stop == 4)) {
    return Abort::kValueRange;
  }
  const bool period = at == object::kPeriodValue || at == object::kPeriodExponent;
  if (period && interpolation_period_us(changed.period_value, changed.period_exponent) == 0) {
    return Abort::kValueRange;
  }
  objects = changed;
  return Abort::kNone;
}

Abort check_mappable(Address at, std::uint8_t bits, bool receive) {
  const ObjectRow* row = find_row(at);
  if (row == nullptr) {
    Entry entry;
    const Abort refused = find_object(at, entry);
    return refused == Abort::kNone ? Abort::kNotMappable : refused;
  }
  const bool allowed = row->mapping == ObjectMapping::kBoth ||
                       row->mapping == (receive ? ObjectMapping::kReceive : kTx);
  return allowed && bits == 8 * row->bytes ? Abort::kNone : Abort::kNotMappable;
}

std::uint32_t interpolation_period_us(std::uint8_t value, std::int8_t exponent) {
  constexpr std::uint64_t kMinuteUs = 60'000'000;
  if (exponent < -6 || exponent > 1) return 0;
  std::uint64_t period_us = value;
  for (int power = -6; power < exponent; ++power) period_us *= 10;
  return period_us > kMinuteUs ? 0 : static_cast<std::uint32_t>(period_us);
}

bool FollowingMonitor::update(const DriveObjects& objects, std::uint64_t now_us) {
  std::int64_t distance = std::int64_t{objects.target_position} - objects.actual_position;
  if (distance < 0) distance = -distance;
  const bool watched = objects.following_window != UINT32_MAX;
  if (!watched || distance <= std::int64_t{objects.following_window}) {
    outside_ = false;
    return false;
  }
  if (!outside_) {
    outside_ = true;
    since_us_ = now_us;
  }
  return now_us >= since_us_ + std::uint64_t{objects.following_time_ms} * 1000;
}

}  // namespace verp::canopen::cia402
