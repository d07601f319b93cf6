#include "firmware/store/program_page.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "hal/fake/fake_flash.hpp"

namespace verp {
namespace {

using Flash = hal::FakeFlash<512, 8>;
constexpr std::size_t kSize = 203;  // ends within a unit

struct Nothing {
  void operator()() const {}
};

struct Bytes {
  explicit Bytes(std::uint8_t first) {
    for (std::size_t i = 0; i < kSize; ++i) byte[i] = static_cast<std::uint8_t>(first + 7 * i);
  }
  bool are_in(const Flash& flash, std::size_t page) const {
    std::uint8_t there[kSize];
    flash.read(page, 0, there, kSize);
    return __builtin_memcmp(there, byte, kSize) == 0;
  }
  std::uint8_t byte[kSize];
};

TEST(ProgramPage, ReplacesWhatWasThereAndLeavesTheOtherPageAlone) {
  Flash flash;
  const Bytes old(1), other(2), fresh(3);
  ASSERT_TRUE(store::program_page(flash, 0, old.byte, kSize, Nothing{}));
  ASSERT_TRUE(store::program_page(flash, 1, other.byte, kSize, Nothing{}));
  EXPECT_TRUE(store::program_page(flash, 0, fresh.byte, kSize, Nothing{}));
  EXPECT_TRUE(fresh.are_in(flash, 0));
  EXPECT_TRUE(other.are_in(flash, 1));
  EXPECT_EQ(flash.misuses(), 0u);
}

TEST(ProgramPage, NeverClaimsWhatTheMemoryDidNotTake) {
  const Bytes bytes(9);
  Flash refusing;
  refusing.refuse(3);
  EXPECT_FALSE(store::program_page(refusing, 0, bytes.byte, kSize, Nothing{}));
  for (std::uint32_t writes = 0; writes < 27; ++writes) {  // an erase and 26 units
    Flash cut(writes + 1);
    cut.cut_after(writes);
    EXPECT_FALSE(store::program_page(cut, 0, bytes.byte, kSize, Nothing{})) << writes;
  }
  Flash whole;
  whole.cut_after(27);
  EXPECT_TRUE(store::program_page(whole, 0, bytes.byte, kSize, Nothing{}));
}

constexpr store::Part kBehind = {256, 200};

/// Page 0 with a robot and, behind it, actions; page 1 is the spare one.
struct Shared {
  explicit Shared(std::uint32_t seed = 1) : flash(seed) {
    flash.erase(0);
    for (std::size_t at = 0; at < 512; at += 8) {
      std::uint8_t unit[8];
      for (std::size_t i = 0; i < 8; ++i) unit[i] = static_cast<std::uint8_t>(3 * at + i + 1);
      flash.program(0, at, unit);
      flash.program(1, at, unit);
    }
    flash.read(0, kBehind.offset, behind, kBehind.size);
  }
  bool replace(const Bytes& fresh) {
    return store::program_beside(flash, 0, fresh.byte, kSize, kBehind, flash, 1, Nothing{});
  }
  bool keeps_behind() const {
    std::uint8_t there[kBehind.size];
    flash.read(0, kBehind.offset, there, sizeof there);
    return __builtin_memcmp(there, behind, sizeof there) == 0;
  }
  Flash flash;
  std::uint8_t behind[kBehind.size];
};

TEST(ProgramPage, ReplacesTheBeginningAndKeepsWhatIsBehind) {
  Shared shared;
  const Bytes fresh(3);
  EXPECT_TRUE(shared.replace(fresh));
  EXPECT_TRUE(fresh.are_in(shared.flash, 0));
  EXPECT_TRUE(shared.keeps_behind());
  EXPECT_EQ(shared.flash.misuses(), 0u);
  std::uint8_t header[16];
  shared.flash.read(1, 0, header, sizeof header);
  for (const std::uint8_t each : header) EXPECT_EQ(each, 0xFF) << "no log's page";
}

// Up to the erase of the page itself nothing in it is lost; whenever it is cut, nobody is told that
// it went well.
TEST(ProgramPage, ACutBesideWhatIsKeptIsNeverASuccess) {
  const Bytes fresh(9);
  constexpr std::uint32_t kSaved = 1 + 25, kAll = kSaved + 1 + 26 + 25;
  for (std::uint32_t writes = 0; writes < kAll; ++writes) {
    Shared shared(writes + 1);
    shared.flash.cut_after(writes);
    EXPECT_FALSE(shared.replace(fresh)) << writes;
    shared.flash.power_up();
    EXPECT_TRUE(writes >= kSaved || shared.keeps_behind()) << writes;
    EXPECT_TRUE(writes <= kSaved + 26 || fresh.are_in(shared.flash, 0)) << writes;
  }
  Shared whole;
  whole.flash.cut_after(kAll);
  EXPECT_TRUE(whole.replace(fresh));
}

TEST(ProgramPage, WhatCannotBeKeptIsNotErased) {
  Shared shared;
  const Bytes fresh(9);
  shared.flash.refuse(3);
  EXPECT_FALSE(shared.replace(fresh));
  EXPECT_TRUE(shared.keeps_behind());
  EXPECT_FALSE(store::program_beside(shared.flash, 0, fresh.byte, kSize, {200, 100}, shared.flash,
                                     1, Nothing{}))
      << "it would be overwritten";
  EXPECT_FALSE(store::program_beside(shared.flash, 0, fresh.byte, kSize, {256, 257}, shared.flash,
                                     1, Nothing{}));
  EXPECT_TRUE(shared.keeps_behind());
}

TEST(ProgramPage, RefusesMoreThanAPageHoldsAndErasesNothing) {
  Flash flash;
  const Bytes bytes(5);
  ASSERT_TRUE(store::program_page(flash, 0, bytes.byte, kSize, Nothing{}));
  static const std::uint8_t much[513] = {};
  EXPECT_FALSE(store::program_page(flash, 0, much, sizeof much, Nothing{}));
  EXPECT_TRUE(bytes.are_in(flash, 0));
}

}  // namespace
}  // namespace verp
