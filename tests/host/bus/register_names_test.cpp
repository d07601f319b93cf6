#include "host/twin/bus/register_names.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "common/protocol/servo_models.hpp"
#include "firmware/app/lockstep_messages.hpp"
#include "host/twin/bus/modem_device.hpp"

namespace verp::bus {
namespace {

TEST(RegisterNames, EveryKnownModelHasANameAndOrderedRegisters) {
  std::vector<std::uint16_t> models = {dxl::kModelImu, dxl::kModelFoot, modem::kModel,
                                       dxl::controller::kModel};
  for (const dxl::ServoModel& servo : dxl::kServoModels) models.push_back(servo.number);
  for (const std::uint16_t model : models) {
    EXPECT_EQ(model_name(model).find("model "), std::string::npos) << model;
    std::set<std::string> names;
    unsigned end = 0;
    for (const NamedRegister& each : registers_of(model)) {
      EXPECT_TRUE(names.insert(each.name).second) << each.name;
      EXPECT_GE(each.address, end) << each.name;
      end = each.address + each.bytes();
      EXPECT_EQ(find_register(model, each.name), &each);
    }
    EXPECT_FALSE(names.empty());
  }
}

// Neighbours check each other: the table has only the e-Manual's gaps.
TEST(RegisterNames, ServoRegistersHaveTheManualsSizes) {
  const auto size = [](const char* name) {
    return find_register(dxl::kModelXm430W350, name)->bytes();
  };
  EXPECT_EQ(size("goal_position"), 4u);
  EXPECT_EQ(size("present_position"), 4u);
  EXPECT_EQ(size("goal_current"), 2u);
  EXPECT_EQ(size("present_input_voltage"), 2u);
  EXPECT_EQ(size("torque_enable"), 1u);
  EXPECT_EQ(size("homing_offset"), 4u);
}

TEST(RegisterNames, AServoHasTheNamesAndUnitsOfItsModel) {
  constexpr std::uint16_t kMx64 = 311, kXl330 = 1200, kXm540 = 1120;
  EXPECT_STREQ(find_register(dxl::kModelXm430W210, "goal_current")->unit, "2.69 mA");
  EXPECT_STREQ(find_register(kMx64, "present_current")->unit, "3.36 mA");
  EXPECT_STREQ(find_register(kXl330, "current_limit")->unit, "1 mA");
  EXPECT_EQ(find_register(kXl330, "current_limit")->maximum, 1750u);
  EXPECT_EQ(find_register(dxl::kModelMx28, "goal_current"), nullptr);
  EXPECT_STREQ(find_register(dxl::kModelMx28, "present_load")->unit, "0.1 %");
  EXPECT_EQ(find_register(dxl::kModelMx28, "startup_configuration"), nullptr);
  EXPECT_NE(find_register(kXm540, "external_port_mode_3"), nullptr);
}

TEST(RegisterNames, TheTwinsClockIsNamed) {
  EXPECT_EQ(model_name(lockstep::kClockModel), "twin's clock");
  const NamedRegister* upright = find_register(lockstep::kClockModel, "set_upright");
  ASSERT_NE(upright, nullptr);
  EXPECT_EQ(upright->address, lockstep::kSetUprightAddress);
}

TEST(RegisterNames, UnknownOnesAreNotGuessed) {
  EXPECT_EQ(model_name(9999), "model 9999");
  EXPECT_TRUE(registers_of(9999).empty());
  EXPECT_EQ(find_register(dxl::kModelMx28, "goal"), nullptr);
}

TEST(RegisterNames, TheControllersPageIsWhatTheTableSays) {
  std::ifstream in(VERP_SOURCE_DIR "/firmware/app/registers.md");
  const std::string committed{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(committed == controller_document())
      << "out of date: ./verp bus registers > firmware/app/registers.md";
}

// e-Manual, Hardware Error Status (70), and an unknown bit.
TEST(RegisterNames, HardwareErrorsAreToldInWords) {
  EXPECT_EQ(hardware_errors(0x01), "input voltage");
  EXPECT_EQ(hardware_errors(0x04 | 0x20), "overheating, overload");
  EXPECT_EQ(hardware_errors(0x08 | 0x10), "motor encoder, electrical shock");
  EXPECT_EQ(hardware_errors(0x80), "unknown: 128");
}

}  // namespace
}  // namespace verp::bus
