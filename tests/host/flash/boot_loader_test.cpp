#include "tests/support/rom_boot_loader.hpp"

#include <gtest/gtest.h>

namespace verp::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes talk(RomBootLoader& chip, const Bytes& bytes) {
  Bytes reply;
  for (const std::uint8_t byte : bytes) chip.take(byte, reply);
  return reply;
}

RomBootLoader awake(const RomBootLoader::Chip& chip = {}) {
  RomBootLoader loader(chip);
  talk(loader, {0x7F});
  return loader;
}

/// AN3155, Write Memory, four bytes at `offset`.
Bytes write_four(RomBootLoader& chip, std::uint8_t offset, const Bytes& data) {
  const auto sum = static_cast<std::uint8_t>(0x08 ^ offset);
  Bytes reply = talk(chip, {0x31, 0xCE, 0x08, 0x00, 0x00, offset, sum});
  Bytes body = {3};
  body.insert(body.end(), data.begin(), data.end());
  std::uint8_t check = 0;
  for (const std::uint8_t byte : body) check ^= byte;
  body.push_back(check);
  for (const std::uint8_t byte : talk(chip, body)) reply.push_back(byte);
  return reply;
}

TEST(RomBootLoader, SaysNothingBeforeTheSyncByte) {
  RomBootLoader chip({});
  EXPECT_EQ(talk(chip, {0x00, 0xFF, 0x02, 0xFD}), Bytes{});
  EXPECT_EQ(talk(chip, {0x7F}), Bytes{0x79});
}

TEST(RomBootLoader, TellsItsCommandsAndItsChip) {
  RomBootLoader chip = awake();
  EXPECT_EQ(talk(chip, {0x00, 0xFF}), (Bytes{0x79, 11, 0x31, 0x00, 0x01, 0x02, 0x11, 0x21, 0x31,
                                             0x44, 0x63, 0x73, 0x82, 0x92, 0x79}));
  EXPECT_EQ(talk(chip, {0x01, 0xFE}), (Bytes{0x79, 0x31, 0, 0, 0x79}));
  EXPECT_EQ(talk(chip, {0x02, 0xFD}), (Bytes{0x79, 1, 0x04, 0x13, 0x79}));
}

TEST(RomBootLoader, RefusesAWrongComplementOrChecksumAndGoesOn) {
  RomBootLoader chip = awake();
  EXPECT_EQ(talk(chip, {0x02, 0xFC}), Bytes{0x1F});
  EXPECT_EQ(talk(chip, {0x7F, 0x02}), Bytes{0x1F}) << "a second sync is half a command";
  EXPECT_EQ(talk(chip, {0x11, 0xEE, 0x08, 0, 0, 0, 0x09}), (Bytes{0x79, 0x1F}));
  EXPECT_EQ(talk(chip, {0x11, 0xEE, 0x07, 0, 0, 0, 0x07}), (Bytes{0x79, 0x1F})) << "no flash";
  EXPECT_EQ(talk(chip, {0x02, 0xFD}).size(), 5u);
}

TEST(RomBootLoader, WritesReadsAndErasesWholeSectors) {
  RomBootLoader chip = awake();
  EXPECT_EQ(write_four(chip, 8, {1, 2, 3, 4}), (Bytes{0x79, 0x79, 0x79}));
  EXPECT_EQ(talk(chip, {0x11, 0xEE, 0x08, 0, 0, 8, 0x00, 3, 0xFC}),
            (Bytes{0x79, 0x79, 0x79, 1, 2, 3, 4}));
  EXPECT_EQ(write_four(chip, 8, {0xFE, 0xFF, 0, 0}).back(), 0x79);
  EXPECT_EQ(chip.flash[8], 0) << "programming only clears bits";
  chip.flash[16 * 1024] = 7;  // sector 1
  EXPECT_EQ(talk(chip, {0x44, 0xBB, 0, 0, 0, 0, 0}), (Bytes{0x79, 0x79}));
  EXPECT_EQ(chip.flash[8], 0xFF);
  EXPECT_EQ(chip.flash[16 * 1024], 7);
  EXPECT_EQ(talk(chip, {0x44, 0xBB, 0xFF, 0xFF, 0x00}), (Bytes{0x79, 0x79}));
  EXPECT_EQ(chip.flash[16 * 1024], 0xFF);
  EXPECT_EQ(talk(chip, {0x44, 0xBB, 0, 0, 0, 12, 12}), (Bytes{0x79, 0x1F})) << "no sector 12";
}

TEST(RomBootLoader, ReadoutProtectionLeavesOnlyTheIdentityAndTheWayOut) {
  RomBootLoader chip = awake({.readout_protected = true});
  EXPECT_EQ(talk(chip, {0x02, 0xFD}).size(), 5u);
  for (const std::uint8_t command : Bytes{0x11, 0x21, 0x31, 0x44}) {
    EXPECT_EQ(talk(chip, {command, static_cast<std::uint8_t>(~command)}), Bytes{0x1F});
  }
  chip.flash[0] = 1;
  EXPECT_EQ(talk(chip, {0x92, 0x6D}), (Bytes{0x79, 0x79}));
  EXPECT_EQ(chip.flash[0], 0xFF) << "lifting it erases all";
  EXPECT_EQ(talk(chip, {0x02, 0xFD}), Bytes{}) << "it was reset";
  EXPECT_EQ(talk(chip, {0x7F, 0x11, 0xEE}), (Bytes{0x79, 0x79}));
}

TEST(RomBootLoader, GoEndsIt) {
  RomBootLoader chip = awake();
  EXPECT_EQ(talk(chip, {0x21, 0xDE, 0x08, 0, 0, 0, 0x08}), (Bytes{0x79, 0x79}));
  EXPECT_TRUE(chip.started);
  EXPECT_EQ(talk(chip, {0x7F}), Bytes{});
}

}  // namespace
}  // namespace verp::test
