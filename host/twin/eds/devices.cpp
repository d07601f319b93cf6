#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/twin/can/device_node.hpp"
#include "host/twin/can/profile_objects.hpp"
#include "host/twin/eds/eds.hpp"
#include "host/twin/eds/initials.hpp"

namespace verp::eds {
namespace {

using canopen::Address;
namespace cia402 = canopen::cia402;

class Rest final : public sim::Plant {
 public:
  std::uint64_t now_us() const override { return 0; }
  void advance_to(std::uint64_t) override {}
  sim::ServoSetpoint& setpoint(int) override { return setpoint_; }
  sim::ServoMeasurement measure(int) override { return {}; }
  sim::ImuMeasurement imu() override { return {}; }
  std::array<std::uint16_t, 4> foot_counts(int) override { return {}; }

 private:
  sim::ServoSetpoint setpoint_;
};

Object numbers(std::uint16_t index, const char* name, std::initializer_list<const char*> members,
               const Value& like) {
  Object object{.index = index, .name = name, .values = {}, .has_members = true, .is_array = true};
  for (const char* each : members) {
    object.values.push_back(like);
    object.values.back().name = each;
  }
  return object;
}

Value value_of(const cia402::ObjectRow& row) {
  return {.name = row.name,
          .type = integer(row.bytes, row.is_signed),
          .writable = row.access == cia402::ObjectAccess::kWrite,
          .mappable = row.mapping != cia402::ObjectMapping::kNone,
          .commissioned = can::is_commissioned(row.at)};
}

/// Rising index.
std::vector<cia402::ObjectRow> profile_of_a_drive() {
  std::vector<cia402::ObjectRow> rows(cia402::kDriveRows,
                                      cia402::kDriveRows + cia402::kDriveRowCount);
  const auto own = can::profile_rows();
  rows.insert(rows.end(), own.begin(), own.end());
  std::sort(rows.begin(), rows.end(), [](const cia402::ObjectRow& a, const cia402::ObjectRow& b) {
    return std::pair(a.at.index, a.at.subindex) < std::pair(b.at.index, b.at.subindex);
  });
  return rows;
}

/// The name of an object with members; null for any other object.
const char* name_of(std::uint16_t index) {
  switch (index) {
    case cia402::object::kMinPosition.index:
      return "Software position limit";
    case cia402::object::kEncoderIncrements.index:
      return "Position encoder resolution";
    case can::profile_at::kSwitchSpeed.index:
      return "Homing speeds";
    case cia402::object::kPeriodValue.index:
      return "Interpolation time period";
    default:
      return nullptr;
  }
}

/// Rows with the same index form one object.
void add_profile(std::vector<Object>& objects) {
  for (const cia402::ObjectRow& row : profile_of_a_drive()) {
    const char* name = name_of(row.at.index);
    if (name != nullptr && objects.back().index == row.at.index) {
      objects.back().values.push_back(value_of(row));
      continue;
    }
    objects.push_back(
        {.index = row.at.index,
         .name = name != nullptr ? name : row.name,
         .values = {value_of(row)},
         .has_members = name != nullptr,
         .is_array = name != nullptr && row.at.index != cia402::object::kPeriodValue.index});
  }
}

template <class Node, class... Parts>
Description describe(const char* file, const char* text, const canopen::Identity& identity,
                     const canopen::DeviceSize& size, const std::vector<Object>& own,
                     Parts... parts) {
  Description description{
      .file = file, .text = text, .identity = identity, .size = size, .objects = {}};
  description.objects = communication_objects(size, identity);
  description.objects.insert(description.objects.end(), own.begin(), own.end());
  Rest plant;
  Node node_1(identity, 1, plant, parts...), node_2(identity, 2, plant, parts...);
  fill_initials(description.objects, node_1.device().objects(), node_2.device().objects());
  return description;
}

}  // namespace

Description drive() {
  constexpr std::uint16_t kModel = 402;  // servo type "cia402_w210" of the ready robots
  const std::string most = std::to_string(can::kMostGain);
  const std::uint16_t telemetry = canopen::plan::kTelemetry.index;
  std::vector<Object> own = {
      {.index = telemetry,
       .name = "Telemetry",
       .values = {{.name = "Telemetry", .type = DataType::kUnsigned32, .mappable = true}}},
      numbers(can::kGains, "Position loop gains", {"P gain", "I gain", "D gain"},
              {.name = "",
               .type = DataType::kUnsigned16,
               .writable = true,
               .commissioned = true,
               .low = "0",
               .high = most})};
  add_profile(own);
  return describe<can::DriveNode>("drive.eds", "CiA 402 drive of the twin",
                                  can::drive_identity(kModel, 1), can::DrivePdos::kSize, own, 0,
                                  can::DriveSetup{});
}

Description imu() {
  const Value like{.name = "", .type = DataType::kInteger16, .mappable = true};
  return describe<can::ImuNode>(
      "imu.eds", "Inertial measurement unit of the twin", can::imu_identity(1), can::ImuPdos::kSize,
      {numbers(canopen::plan::kGyro[0].index, "Gyro", {"Gyro x", "Gyro y", "Gyro z"}, like),
       numbers(canopen::plan::kAccel[0].index, "Accelerometer",
               {"Acceleration x", "Acceleration y", "Acceleration z"}, like)});
}

Description foot() {
  return describe<can::FootNode>(
      "foot.eds", "Force sensors of a foot of the twin", can::foot_identity(1),
      can::FootPdos::kSize,
      {numbers(canopen::plan::kFoot[0].index, "Force",
               {"Force front left", "Force front right", "Force back left", "Force back right"},
               {.name = "", .type = DataType::kUnsigned16, .mappable = true})},
      0);
}

}  // namespace verp::eds
