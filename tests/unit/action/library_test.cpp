#include <gtest/gtest.h>

#include "tests/unit/action/shelf.hpp"

namespace verp::action {
namespace {

using test::Shelf;

LibraryFault fault_of(const Shelf& shelf) {
  return check_library(&shelf, sizeof shelf);
}

TEST(Library, IsReadAsItWasWritten) {
  Shelf shelf;
  shelf.goal(1, 3, 0.5F);
  const Library library = shelf.library();
  ASSERT_EQ(library.count(), 2);
  EXPECT_STREQ(library.action(2).name, "b");
  EXPECT_EQ(library.frame(1).goal_tenth_mrad[3], 5000);
}

TEST(Library, NothingIsNoActions) {
  EXPECT_EQ(Library(nullptr, 0).count(), 0);
  EXPECT_EQ(Library().count(), 0);
}

TEST(Library, AnyFlippedBitIsRefused) {
  Shelf shelf;
  auto* bytes = reinterpret_cast<unsigned char*>(&shelf);
  for (std::size_t at = 0; at < sizeof shelf; ++at) {
    bytes[at] = static_cast<unsigned char>(bytes[at] ^ 0x10);
    EXPECT_NE(fault_of(shelf), LibraryFault::kNone) << "byte " << at;
    bytes[at] = static_cast<unsigned char>(bytes[at] ^ 0x10);
  }
  EXPECT_EQ(fault_of(shelf), LibraryFault::kNone);
}

TEST(Library, ShortOneIsRefusedAtAnyLength) {
  const Shelf shelf;
  for (std::size_t size = 0; size < sizeof shelf; ++size) {
    EXPECT_EQ(check_library(&shelf, size), LibraryFault::kTruncated);
  }
}

TEST(Library, WhatPointsOutsideIsRefusedThoughItsCrcFits) {
  Shelf shelf;
  shelf.frame[0].next = 3;
  shelf.seal();
  EXPECT_EQ(fault_of(shelf), LibraryFault::kOutOfBounds);
  shelf = Shelf{};
  shelf.action[1].frames = 2;
  shelf.seal();
  EXPECT_EQ(fault_of(shelf), LibraryFault::kOutOfBounds);
  shelf = Shelf{};
  shelf.frame[2].time_ms = 0;  // a player would loop on such frames for ever
  shelf.seal();
  EXPECT_EQ(fault_of(shelf), LibraryFault::kOutOfBounds);
  shelf = Shelf{};
  shelf.header.library_version = kLibraryVersion + 1;
  EXPECT_EQ(fault_of(shelf), LibraryFault::kOtherLayout);
}

TEST(Library, EachFieldOutsideItsRangeIsRefused) {
  for (int field = 0; field < 8; ++field) {
    Shelf shelf;
    if (field == 0) shelf.frame[1].loop_to = 3;
    if (field == 1) shelf.frame[1].exit = 3;
    if (field == 2) shelf.frame[1].otherwise = 3;
    if (field == 3) shelf.frame[1].stiffness_percent[kMaxJoints - 1] = 101;
    if (field == 4) shelf.frame[1].condition = static_cast<Condition>(kConditions);
    if (field == 5) shelf.frame[1].balance = 2;
    if (field == 6) shelf.action[1].frames = 0;
    if (field == 7) shelf.action[1].name[kNameLength - 1] = 'x';
    shelf.seal();
    EXPECT_EQ(fault_of(shelf), LibraryFault::kOutOfBounds) << field;
  }
}

}  // namespace
}  // namespace verp::action
