#pragma once
#include <cstddef>
#include <cstdint>

#include "common/io/io.hpp"

/// A controller's report of each tick, in event-driven TPDOs. With drives' and sensors' frames a
/// listener knows the tick's Inputs and their digest:
///
///     TPDO 2   chained digest of all ticks so far                                     each tick
///     TPDO 3   tick (low 16 bits), fresh mask, flags                                  each tick
///     TPDO 4   up to 6 bytes of Inputs that no other frame of the bus holds:          when it
///              operator's orders, parameter writes, a chip's IMU                      changes
///
/// After the tick's goals, which have lower identifiers. Little-endian.
namespace verp::canopen::published {

inline constexpr unsigned kDigestPdo = 2;
inline constexpr unsigned kRecordPdo = 3;
inline constexpr unsigned kPartPdo = 4;
inline constexpr int kFrames = 2;
inline constexpr std::uint8_t kFrameBytes = 8;

// Flags: Inputs::flags' low byte, and
inline constexpr std::uint16_t kInputsMask = 0x00FF;
inline constexpr std::uint16_t kImuInParts = 1 << 8;  ///< IMU counts are not from the bus
inline constexpr int kPartsShift = 12;                ///< number of parts, from here
/// Most parts in a tick. With more, none are sent, and the listener must ask for them.
inline constexpr int kMostParts = 6;
inline constexpr unsigned kTooManyParts = 15;

inline constexpr std::size_t kPartBytes = 6;
/// Parts of the IMU's counts: gyro and accelerometer.
inline constexpr int kImuParts = 2;
static_assert(sizeof(Inputs::gyro_count) + sizeof(Inputs::accel_count) == kImuParts * kPartBytes);
/// Most parts of orders: a Command, a parameter write, the mailbox.
inline constexpr int kOrderParts = 4;
static_assert(sizeof(Command) == 2 * kPartBytes && kImuParts + kOrderParts == kMostParts);
static_assert(sizeof(Inputs) % 2 == 0 && sizeof(Inputs) / 2 <= 256);

/// A part: half the offset into Inputs, size, bytes.
struct Part {
  std::uint8_t place = 0;
  std::uint8_t size = 0;
  std::uint8_t bytes[kPartBytes] = {};

  static Part from(std::uint64_t value) {
    Part part;
    __builtin_memcpy(reinterpret_cast<std::uint8_t*>(&part), &value, sizeof part);
    return part;
  }
  std::uint64_t value() const {
    std::uint64_t value;
    __builtin_memcpy(&value, this, sizeof value);
    return value;
  }
  /// False, without effect, if it lies outside.
  bool put(Inputs& inputs) const {
    const std::size_t offset = 2u * place;
    if (size > kPartBytes || offset + size > sizeof(Inputs)) return false;
    __builtin_memcpy(reinterpret_cast<std::uint8_t*>(&inputs) + offset, bytes, size);
    return true;
  }
};
static_assert(sizeof(Part) == kFrameBytes);

/// Copies the part that frames of record, drives and sensors carry. `imu`: the IMU is on the bus.
inline void copy_heard(Inputs& to, const Inputs& from, bool imu) {
  to.tick = from.tick;
  to.fresh = from.fresh;
  to.flags = from.flags;
  for (int j = 0; j < kMaxJoints; ++j) {
    if ((from.fresh >> j & 1) != 0) to.position_count[j] = from.position_count[j];
  }
  if ((from.flags & kImuFresh) != 0 && imu) {
    __builtin_memcpy(to.gyro_count, from.gyro_count, sizeof to.gyro_count);
    __builtin_memcpy(to.accel_count, from.accel_count, sizeof to.accel_count);
  }
  if ((from.flags & kFeetFresh) != 0) {
    __builtin_memcpy(to.foot_count, from.foot_count, sizeof to.foot_count);
  }
  if ((from.flags & kSlowFresh) != 0) {
    to.slow_joint = from.slow_joint;
    to.slow_temperature_c = from.slow_temperature_c;
    to.slow_error = from.slow_error;
    to.slow_voltage_tenth_v = from.slow_voltage_tenth_v;
  }
}

class Parts {
 public:
  /// Finds the parts of `now` that a listener lacks if it knows `before` and hears the bus.
  void find(const Inputs& before, const Inputs& now, bool bus_imu) {
    Inputs heard = before;
    copy_heard(heard, now, bus_imu);
    flags_ = static_cast<std::uint16_t>((now.flags & kInputsMask) | (bus_imu ? 0 : kImuInParts));
    count_ = 0;
    const auto* had = reinterpret_cast<const std::uint8_t*>(&heard);
    const auto* has = reinterpret_cast<const std::uint8_t*>(&now);
    for (std::size_t at = 0; at < sizeof(Inputs); at += 2) {
      if (had[at] == has[at] && had[at + 1] == has[at + 1]) continue;
      if (count_ == kMostParts) {
        too_many();
        return;
      }
      const std::size_t left = sizeof(Inputs) - at;
      Part& part = part_[count_++];
      part.place = static_cast<std::uint8_t>(at / 2);
      part.size = static_cast<std::uint8_t>(left < kPartBytes ? left : kPartBytes);
      __builtin_memcpy(part.bytes, has + at, part.size);
      at += part.size - 2u;
    }
    flags_ = static_cast<std::uint16_t>(flags_ | count_ << kPartsShift);
  }

  int count() const { return count_; }
  const Part& part(int i) const { return part_[i]; }
  std::uint16_t flags() const { return flags_; }

 private:
  void too_many() {
    count_ = 0;
    flags_ = static_cast<std::uint16_t>(flags_ | kTooManyParts << kPartsShift);
  }

  Part part_[kMostParts];
  int count_ = 0;
  std::uint16_t flags_ = 0;
};

}  // namespace verp::canopen::published
