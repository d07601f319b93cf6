#include "host/twin/can/profile_objects.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::cia402::ObjectAccess;
using canopen::cia402::ObjectMapping;
using canopen::cia402::ObjectRow;

static_assert(std::is_standard_layout_v<ProfileObjects>);

#define VERP_PROFILE_ROW(at, name, member, mapping)                                               \
  ObjectRow {                                                                                     \
    at, name, sizeof(ProfileObjects::member), std::is_signed_v<decltype(ProfileObjects::member)>, \
        ObjectAccess::kWrite, mapping, offsetof(ProfileObjects, member)                           \
  }

constexpr ObjectMapping kSetting = ObjectMapping::kNone;
constexpr ObjectMapping kLive = ObjectMapping::kBoth;
constexpr ObjectRow kProfileRows[] = {
    VERP_PROFILE_ROW(profile_at::kPositionWindow, "Position window", position_window, kSetting),
    VERP_PROFILE_ROW(profile_at::kPositionWindowTime, "Position window time",
                     position_window_time_ms, kSetting),
    VERP_PROFILE_ROW(profile_at::kMaxVelocity, "Max profile velocity", max_velocity, kLive),
    VERP_PROFILE_ROW(profile_at::kVelocity, "Profile velocity", velocity, kLive),
    VERP_PROFILE_ROW(profile_at::kAcceleration, "Profile acceleration", acceleration, kLive),
    VERP_PROFILE_ROW(profile_at::kDeceleration, "Profile deceleration", deceleration, kLive),
    VERP_PROFILE_ROW(profile_at::kProfileType, "Motion profile type", profile_type, kSetting),
    VERP_PROFILE_ROW(profile_at::kHomingMethod, "Homing method", homing_method, kLive),
    VERP_PROFILE_ROW(profile_at::kSwitchSpeed, "Speed during search for switch", switch_speed,
                     kSetting),
    VERP_PROFILE_ROW(profile_at::kZeroSpeed, "Speed during search for zero", zero_speed, kSetting),
    VERP_PROFILE_ROW(profile_at::kHomingAcceleration, "Homing acceleration", homing_acceleration,
                     kSetting),
};

const ObjectRow* profile_row(Address at) {
  const auto* found = std::find_if(std::begin(kProfileRows), std::end(kProfileRows),
                                   [at](const ObjectRow& row) { return row.at == at; });
  return found == std::end(kProfileRows) ? nullptr : found;
}

std::uint8_t profile_members(std::uint16_t index) {
  return index == profile_at::kZeroSpeed.index ? profile_at::kZeroSpeed.subindex : 0;
}

}  // namespace

std::span<const ObjectRow> profile_rows() {
  return kProfileRows;
}

bool is_profile_object(std::uint16_t index) {
  return std::any_of(std::begin(kProfileRows), std::end(kProfileRows),
                     [index](const ObjectRow& row) { return row.at.index == index; });
}

bool is_commissioned(Address at) {
  return at == profile_at::kVelocity || at == profile_at::kAcceleration ||
         at == profile_at::kDeceleration;
}

Abort find_profile(Address at, canopen::Entry& entry) {
  if (const ObjectRow* row = profile_row(at); row != nullptr) {
    entry = {true, true, row->bytes, row->bytes, row->bytes};
    return Abort::kNone;
  }
  if (at.subindex != 0 || profile_members(at.index) == 0) return Abort::kNoSubindex;
  entry = {true, false, 1, 1, 1};
  return Abort::kNone;
}

void read_profile(const ProfileObjects& objects, Address at, std::uint8_t* buffer) {
  const ObjectRow* row = profile_row(at);
  if (row == nullptr) {
    buffer[0] = profile_members(at.index);
    return;
  }
  std::memcpy(buffer, reinterpret_cast<const std::uint8_t*>(&objects) + row->place, row->bytes);
}

Abort write_profile(ProfileObjects& objects, Address at, const std::uint8_t* data) {
  const ObjectRow* row = profile_row(at);
  if (row == nullptr) return Abort::kReadOnly;
  ProfileObjects changed = objects;
  std::memcpy(reinterpret_cast<std::uint8_t*>(&changed) + row->place, data, row->bytes);
  const bool ramps = at == profile_at::kAcceleration || at == profile_at::kDeceleration;
  if (ramps && std::min(changed.acceleration, changed.deceleration) == 0) return Abort::kValueRange;
  if (changed.profile_type != 0) return Abort::kValueRange;
  if (changed.homing_method != 0 && !homes_in_place(changed.homing_method)) {
    return Abort::kValueRange;
  }
  objects = changed;
  return Abort::kNone;
}

Abort profile_mappable(Address at, std::uint8_t bits) {
  const ObjectRow* row = profile_row(at);
  if (row == nullptr)
    return profile_members(at.index) == 0 ? Abort::kNoSubindex : Abort::kNotMappable;
  return row->mapping == kLive && bits == 8 * row->bytes ? Abort::kNone : Abort::kNotMappable;
}

}  // namespace verp::can
