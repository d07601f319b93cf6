#include "common/protocol/controller_table.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"

namespace verp::dxl::controller {
namespace {

TEST(ControllerTable, RegistersStandInOrderAndShareNoByte) {
  unsigned end = 0;
  for (const Register& each : kTable) {
    EXPECT_GE(each.address, end) << each.name;
    EXPECT_GT(each.count, 0) << each.name;
    end = each.address + each.bytes();
  }
  EXPECT_EQ(end, kTableBytes);
}

TEST(ControllerTable, NamesAreUniqueAndSayEverythingInOneCase) {
  for (const Register& each : kTable) {
    EXPECT_EQ(find(each.name), &each) << each.name;
    for (const char* c = each.name; *c != '\0'; ++c) {
      const bool plain = (*c >= 'a' && *c <= 'z') || (*c >= '0' && *c <= '9') || *c == '_';
      EXPECT_TRUE(plain) << each.name;
    }
    EXPECT_TRUE(each.name[0] != '\0' && each.meaning[0] != '\0') << each.address;
  }
  EXPECT_TRUE(find("no_such_register") == nullptr);
  EXPECT_TRUE(find("") == nullptr);
}

// So reads of aligned blocks never tear a word.
TEST(ControllerTable, ElementsStandOnMultiplesOfTheirSize) {
  for (const Register& each : kTable) {
    if (each.address == address::kModelInformation) continue;
    EXPECT_EQ(each.address % type_bytes(each.type), 0) << each.name;
  }
}

TEST(ControllerTable, WhatEveryDynamixelHasStandsWhereItIsExpected) {
  EXPECT_EQ(find("model_number")->address, address::kModelNumber);
  EXPECT_EQ(find("model_information")->address, address::kModelInformation);
  EXPECT_EQ(find("firmware_version")->address, address::kFirmwareVersion);
  EXPECT_EQ(find("id")->address, address::kId);
  EXPECT_EQ(find("torque_enable")->address, address::kTorqueEnable);
  EXPECT_EQ(find("status_return_level")->address, address::kStatusReturnLevel);
  EXPECT_EQ(find("registered_instruction")->address, address::kRegisteredInstruction);
  EXPECT_EQ(find("hardware_error")->address, address::kHardwareError);
}

TEST(ControllerTable, EachRegisterCanBeReadAndWrittenInOnePacket) {
  constexpr std::size_t kOverhead = kStatusBytes + 2;  // a write's address is longer than an error
                                                       // field
  for (const Register& each : kTable) {
    EXPECT_LE(each.bytes() + each.bytes() / 3 + kOverhead, kMaxPacket) << each.name;
  }
  EXPECT_LE(longest_write() + longest_write() / 3 + kOverhead, kMaxPacket);
}

TEST(ControllerTable, RulesAreTheTableWithoutItsWords) {
  for (unsigned address = 0; address < 0x10000; ++address) {
    const Register* expected = nullptr;
    for (const Register& each : kTable) {
      if (address < each.address || address >= each.address + each.bytes()) continue;
      if ((address - each.address) % type_bytes(each.type) == 0) expected = &each;
    }
    const Rule* rule = rule_at(static_cast<std::uint16_t>(address));
    ASSERT_EQ(rule != nullptr, expected != nullptr) << address;
    if (rule == nullptr) continue;
    ASSERT_EQ(rule->address, expected->address);
    ASSERT_EQ(rule->size, type_bytes(expected->type));
    ASSERT_TRUE(rule->access == expected->access);
    ASSERT_EQ(rule->minimum, expected->minimum);
    ASSERT_EQ(rule->maximum(), expected->minimum < 0 ? static_cast<std::int32_t>(expected->maximum)
                                                     : std::int64_t{expected->maximum});
    if (address > kTableBytes + 8u) address += 97;
  }
}

TEST(ControllerTable, WritableRangesFitTheirTypes) {
  for (const Register& each : kTable) {
    if (!each.writable()) continue;
    const bool is_signed = each.type == Type::kI16 || each.type == Type::kI32;
    EXPECT_EQ(each.minimum < 0, is_signed) << each.name;
    EXPECT_LE(type_bytes(each.type), 4) << each.name;
    const std::uint64_t most = (std::uint64_t{1} << (8 * type_bytes(each.type))) - 1;
    EXPECT_LE(std::uint64_t{each.maximum}, is_signed ? most / 2 : most) << each.name;
  }
}

// CiA 301: 2000h to 5FFFh; at most 254 elements.
TEST(ControllerTable, MakesAnObjectDictionary) {
  for (const Register& each : kTable) {
    EXPECT_GE(each.object_index(), 0x2000) << each.name;
    EXPECT_LT(each.object_index(), 0x6000) << each.name;
    EXPECT_LE(each.count, 254) << each.name;
  }
}

}  // namespace
}  // namespace verp::dxl::controller
