#include "host/twin/can/sensor.hpp"

#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"

namespace verp::can {
namespace {

using canopen::Abort;
using canopen::Address;
using canopen::Entry;

constexpr std::uint8_t kAxes = 3;
const std::uint16_t kGyro = canopen::plan::kGyro[0].index;
const std::uint16_t kAccel = canopen::plan::kAccel[0].index;
const std::uint16_t kFoot = canopen::plan::kFoot[0].index;

}  // namespace

Abort SensorApplication::find(Address at, Entry& entry) const {
  const std::uint8_t numbers = count(at.index);
  if (numbers == 0) return Abort::kNoObject;
  if (at.subindex > numbers) return Abort::kNoSubindex;
  const std::uint32_t bytes = at.subindex == 0 ? 1 : 2;
  entry = {true, false, bytes, bytes, bytes};
  return Abort::kNone;
}
Abort SensorApplication::read(Address at, std::uint32_t, std::uint8_t* buffer,
                              std::uint32_t size) const {
  canopen::put_le(buffer, get(at, 16), size);
  return Abort::kNone;
}
Abort SensorApplication::write(Address at, const std::uint8_t*, std::uint32_t) const {
  Entry entry;
  const Abort found = find(at, entry);
  return found == Abort::kNone ? Abort::kReadOnly : found;
}
Abort SensorApplication::mappable(Address at, std::uint8_t bits, bool receive) const {
  Entry entry;
  const Abort found = find(at, entry);
  if (found != Abort::kNone) return found;
  return !receive && at.subindex != 0 && bits == 16 ? Abort::kNone : Abort::kNotMappable;
}
// Subindex 0 holds the count.
std::uint64_t SensorApplication::get(Address at, std::uint8_t) const {
  return at.subindex == 0 ? count(at.index) : number(at.index, at.subindex - 1);
}

std::uint8_t ImuApplication::count(std::uint16_t index) const {
  return index == kGyro || index == kAccel ? kAxes : std::uint8_t{0};
}
std::uint16_t ImuApplication::number(std::uint16_t index, int i) const {
  const sim::ImuMeasurement measured = plant_.imu();
  const auto& axes = index == kGyro ? measured.gyro_count : measured.accel_count;
  return static_cast<std::uint16_t>(axes[static_cast<std::size_t>(i)]);
}

std::uint8_t FootApplication::count(std::uint16_t index) const {
  return index == kFoot ? static_cast<std::uint8_t>(kFootSensors) : std::uint8_t{0};
}
std::uint16_t FootApplication::number(std::uint16_t, int i) const {
  return plant_.foot_counts(foot_)[static_cast<std::size_t>(i)];
}

}  // namespace verp::can
