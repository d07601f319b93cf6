#include "host/can/sensor.hpp"

#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

// Both kinds of sensor are arrays of 16-bit numbers that can be read and mapped, and no more.
namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::Entry;

constexpr std::uint8_t kAxes = 3;
const std::uint16_t kGyro = canopen::plan::kGyro[0].index;
const std::uint16_t kAccel = canopen::plan::kAccel[0].index;
const std::uint16_t kFoot = canopen::plan::kFoot[0].index;

/// Of an array with `count` numbers; subindex 0 says how many.
Abort find_number(Address at, std::uint8_t count, Entry& entry) {
  if (count == 0) return Abort::kNoObject;
  if (at.subindex > count) return Abort::kNoSubindex;
  const std::uint32_t bytes = at.subindex == 0 ? 1 : 2;
  entry = {true, false, bytes, bytes, bytes};
  return Abort::kNone;
}
Abort refuse_write(Abort found) {
  return found == Abort::kNone ? Abort::kReadOnly : found;
}
Abort map_number(Abort found, Address at, std::uint8_t bits, bool receive) {
  if (found != Abort::kNone) return found;
  return !receive && at.subindex != 0 && bits == 16 ? Abort::kNone : Abort::kNotMappable;
}

std::uint8_t imu_count(std::uint16_t index) {
  return index == kGyro || index == kAccel ? kAxes : std::uint8_t{0};
}
std::uint8_t foot_count(std::uint16_t index) {
  return index == kFoot ? static_cast<std::uint8_t>(kFootSensors) : std::uint8_t{0};
}

}  // namespace

Abort ImuApplication::find(Address at, Entry& entry) const {
  return find_number(at, imu_count(at.index), entry);
}
Abort ImuApplication::read(Address at, std::uint32_t, std::uint8_t* buffer,
                           std::uint32_t size) const {
  canopen::put_le(buffer, get(at, 16), size);
  return Abort::kNone;
}
Abort ImuApplication::write(Address at, const std::uint8_t*, std::uint32_t) const {
  Entry entry;
  return refuse_write(find(at, entry));
}
Abort ImuApplication::mappable(Address at, std::uint8_t bits, bool receive) const {
  Entry entry;
  return map_number(find(at, entry), at, bits, receive);
}
std::uint64_t ImuApplication::get(Address at, std::uint8_t) const {
  if (at.subindex == 0) return kAxes;
  const sim::ImuMeasurement measured = plant_.imu();
  const auto& axes = at.index == kGyro ? measured.gyro_count : measured.accel_count;
  return static_cast<std::uint16_t>(axes[at.subindex - 1u]);
}

Abort FootApplication::find(Address at, Entry& entry) const {
  return find_number(at, foot_count(at.index), entry);
}
Abort FootApplication::read(Address at, std::uint32_t, std::uint8_t* buffer,
                            std::uint32_t size) const {
  canopen::put_le(buffer, get(at, 16), size);
  return Abort::kNone;
}
Abort FootApplication::write(Address at, const std::uint8_t*, std::uint32_t) const {
  Entry entry;
  return refuse_write(find(at, entry));
}
Abort FootApplication::mappable(Address at, std::uint8_t bits, bool receive) const {
  Entry entry;
  return map_number(find(at, entry), at, bits, receive);
}
std::uint64_t FootApplication::get(Address at, std::uint8_t) const {
  if (at.subindex == 0) return kFootSensors;
  return plant_.foot_counts(foot_)[at.subindex - 1u];
}

}  // namespace verp::can
