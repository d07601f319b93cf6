#include "common/action/kept.hpp"

#include <gtest/gtest.h>

#include "tests/unit/action/shelf.hpp"

namespace verp::action {
namespace {

Params robot_named(const char* name) {
  Params params;
  __builtin_strncpy(params.name, name, sizeof params.name - 1);
  params.joint_count = 3;
  for (int j = 0; j < 3; ++j) params.joint[j].name[0] = static_cast<char>('a' + j);
  return params;
}

struct Section {
  explicit Section(const Params& params) {
    __builtin_memset(bytes, 0xFF, sizeof bytes);
    const test::Shelf shelf;
    const KeptMark mark = make_mark(shelf.header, params);
    __builtin_memcpy(bytes, &shelf, sizeof shelf);
    __builtin_memcpy(bytes + sizeof shelf, &mark, sizeof mark);
  }
  static constexpr std::size_t kUsed = sizeof(test::Shelf) + sizeof(KeptMark);
  alignas(4) unsigned char bytes[kUsed + 64];
};

TEST(KeptActions, CountForTheRobotTheyWereMadeFor) {
  const Params params = robot_named("r");
  const Section section(params);
  const KeptLibrary kept(section.bytes, sizeof section.bytes, params);
  EXPECT_EQ(kept.fault, KeptFault::kNone);
  EXPECT_EQ(kept.library.count(), 2);
}

TEST(KeptActions, AnErasedSectionIsNoneAndNoFault) {
  alignas(4) unsigned char bytes[256];
  __builtin_memset(bytes, 0xFF, sizeof bytes);
  const KeptLibrary kept(bytes, sizeof bytes, robot_named("r"));
  EXPECT_EQ(kept.fault, KeptFault::kNone);
  EXPECT_EQ(kept.library.count(), 0);
  __builtin_memset(bytes, 0, sizeof bytes);
  EXPECT_EQ(check_kept(bytes, sizeof bytes, robot_named("r")), KeptFault::kNotALibrary);
}

// Changed gains, friction or tuning still fit; another name, joint or limit means another robot.
TEST(KeptActions, OfAnotherRobotDoNotCount) {
  const Params params = robot_named("r");
  const Section section(params);
  const auto fault_for = [&](auto change) {
    Params other = params;
    change(other);
    const KeptLibrary kept(section.bytes, sizeof section.bytes, other);
    EXPECT_EQ(kept.library.count() > 0, kept.fault == KeptFault::kNone);
    return kept.fault;
  };
  EXPECT_EQ(fault_for([](Params& p) { p.name[0] = 's'; }), KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint_count = 2; }), KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint[2].name[1] = 'x'; }), KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint[0].axis.x = 1; }), KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint[1].origin_parent_m.z = 0.1F; }),
            KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint[1].upper_rad = 1; }), KeptFault::kOtherRobot);
  EXPECT_EQ(fault_for([](Params& p) { p.joint[1].friction_n_m = 1; }), KeptFault::kNone);
  EXPECT_EQ(fault_for([](Params& p) { p.servo[0].position_p_gain = 1; }), KeptFault::kNone);
  EXPECT_EQ(fault_for([](Params& p) { p.tuning.gait.lift_m = 0.02F; }), KeptFault::kNone);
  EXPECT_EQ(fault_for([](Params& p) { p.bus_protocol = BusProtocol::kCia402; }), KeptFault::kNone);
}

TEST(KeptActions, AnyFlippedBitIsAFault) {
  const Params params = robot_named("r");
  Section section(params);
  for (std::size_t at = 0; at < Section::kUsed; ++at) {
    section.bytes[at] = static_cast<unsigned char>(section.bytes[at] ^ 0x10);
    const KeptFault fault = check_kept(section.bytes, sizeof section.bytes, params);
    EXPECT_NE(fault, KeptFault::kNone) << "byte " << at;
    EXPECT_NE(fault, KeptFault::kOtherRobot) << "byte " << at;
    EXPECT_EQ(check_any_kept(section.bytes, sizeof section.bytes), fault) << "byte " << at;
    section.bytes[at] = static_cast<unsigned char>(section.bytes[at] ^ 0x10);
  }
}

TEST(KeptActions, WhatIsCutAnywhereDoesNotCount) {
  const Params params = robot_named("r");
  for (std::size_t whole = 4; whole < Section::kUsed; whole += 4) {
    Section section(params);
    __builtin_memset(section.bytes + whole, 0xFF, sizeof section.bytes - whole);
    EXPECT_NE(check_kept(section.bytes, sizeof section.bytes, params), KeptFault::kNone) << whole;
  }
  const Section section(params);
  EXPECT_EQ(check_kept(section.bytes, Section::kUsed - 1, params), KeptFault::kTruncated);
  EXPECT_EQ(check_kept(section.bytes, sizeof(test::Shelf), params), KeptFault::kTruncated);
  EXPECT_EQ(check_kept(section.bytes, Section::kUsed, params), KeptFault::kNone);
}

}  // namespace
}  // namespace verp::action
