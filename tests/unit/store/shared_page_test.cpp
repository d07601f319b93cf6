#include "firmware/store/shared_page.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/store/flash_store.hpp"
#include "hal/fake/fake_flash.hpp"

// A robot and its actions are replaced together or not at all; the log never loses a value.

namespace verp {
namespace {

constexpr std::size_t kFirst = 99, kSecond = 128, kSecondBytes = 117, kRoom = 120;
constexpr std::uint16_t kKey = 7;

/// When one memory loses power, the other stops, too.
template <class Own, class Peer>
struct Wired {
  static constexpr std::size_t kUnit = Own::kUnit;
  std::size_t page_bytes(std::size_t page) const { return own.page_bytes(page); }
  const std::uint8_t* memory(std::size_t page) const { return own.memory(page); }
  void read(std::size_t page, std::size_t offset, std::uint8_t* to, std::size_t size) const {
    own.read(page, offset, to, size);
  }
  bool program(std::size_t page, std::size_t offset, const std::uint8_t* from) {
    return !peer.dark() && own.program(page, offset, from);
  }
  bool erase(std::size_t page) { return !peer.dark() && own.erase(page); }
  Own& own;
  Peer& peer;
};

struct Nothing {
  void operator()() const {}
};

template <std::size_t kSize>
struct Bytes {
  explicit Bytes(int generation) {
    for (std::size_t i = 0; i < kSize; ++i) {
      byte[i] = static_cast<std::uint8_t>(31 * generation + 7 * static_cast<int>(i));
    }
  }
  std::uint8_t byte[kSize];
};
using First = Bytes<kFirst>;
using Second = Bytes<kSecondBytes>;

struct Board {
  using HomeFlash = hal::FakeFlash<256, 8>;
  using OtherFlash = hal::FakeFlash<512, 8>;
  using Home = Wired<HomeFlash, OtherFlash>;
  using Other = Wired<OtherFlash, HomeFlash>;
  using Log = store::FlashStore<Other, 4, 64>;
  using Room = store::WaitingRoom<Home, Other, Log>;
  static_assert(store::MappedPages<Other>);

  explicit Board(std::uint32_t seed = 1) : home_flash(seed), other_flash(seed + 1) {
    store::program_bytes(home, 0, 0, First(0).byte, kFirst, Nothing{});
    store::program_bytes(home, 0, kSecond, Second(0).byte, kSecondBytes, Nothing{});
    start();
    keep(1);
  }
  void start() {
    log = Log(other);
    room = new (room_place) Room(home, kSecond, kRoom, other, log);
    home_flash.power_up();
    other_flash.power_up();
    store::finish_waiting(home, other, Nothing{});
    log.open();
  }
  void keep(std::uint8_t value) {
    ASSERT_EQ(log.put(kKey, &value, 1), hal::PutResult::kAccepted);
    for (int i = 0; i < 100 && log.work(true) == hal::WorkState::kWorking;) ++i;
  }
  std::uint8_t kept() const {
    std::uint8_t value = 0;
    log.get(kKey, &value, 1);
    return value;
  }
  bool send(int generation) {
    const Second second(generation);
    room->begin();
    room->work(true);
    if (!room->ready()) return false;
    for (std::size_t at = 0; at < kSecondBytes; at += 50) {
      const std::size_t left = kSecondBytes - at;
      if (!room->write(at, second.byte + at, left < 50 ? left : 50)) return false;
    }
    return __builtin_memcmp(room->bytes(), second.byte, kSecondBytes) == 0;
  }
  bool holds(int first, int second) const {
    return __builtin_memcmp(home.memory(0), First(first).byte, kFirst) == 0 &&
           __builtin_memcmp(home.memory(0) + kSecond, Second(second).byte, kSecondBytes) == 0;
  }
  std::uint32_t misuses() const { return home_flash.misuses() + other_flash.misuses(); }

  HomeFlash home_flash;
  OtherFlash other_flash;
  Home home{home_flash, other_flash};
  Other other{other_flash, home_flash};
  Log log{other};
  alignas(Room) unsigned char room_place[sizeof(Room)];
  Room* room = nullptr;
};

TEST(SharedPage, TheSecondIsReplacedAndTheFirstStays) {
  Board board;
  ASSERT_TRUE(board.send(1));
  EXPECT_TRUE(board.holds(0, 0)) << "it only waits";
  EXPECT_TRUE(board.room->replace(nullptr, kFirst, kSecondBytes, kSecondBytes, Nothing{}));
  EXPECT_TRUE(board.holds(0, 1));
  board.start();
  EXPECT_TRUE(board.holds(0, 1)) << "and is not replaced once more";
  EXPECT_EQ(board.kept(), 1);
  EXPECT_EQ(board.misuses(), 0u);
}

TEST(SharedPage, TheFirstIsReplacedAndTheSecondStays) {
  Board board;
  const First first(1);
  EXPECT_TRUE(board.room->replace(first.byte, kFirst, 0, kSecondBytes, Nothing{}));
  EXPECT_TRUE(board.holds(1, 0));
  ASSERT_TRUE(board.send(2));
  EXPECT_TRUE(board.room->replace(First(3).byte, kFirst, 0, kSecondBytes, Nothing{}));
  EXPECT_TRUE(board.holds(3, 0));
  EXPECT_EQ(board.misuses(), 0u);
}

TEST(SharedPage, BothAreReplaced) {
  Board board;
  ASSERT_TRUE(board.send(1));
  EXPECT_TRUE(board.room->replace(First(1).byte, kFirst, kSecondBytes, 0, Nothing{}));
  EXPECT_TRUE(board.holds(1, 1));
}

TEST(SharedPage, APowerCutLeavesTheOldOrTheNew) {
  int old_ones = 0, new_ones = 0;
  for (const bool at_home : {false, true}) {
    bool whole = false;
    for (std::uint32_t writes = 0; !whole; ++writes) {
      ASSERT_LT(writes, 200u);
      Board board(writes + 1);
      if (at_home) {
        board.home_flash.cut_after(writes);
      } else {
        board.other_flash.cut_after(writes);
      }
      const bool sent = board.send(1);
      const bool replaced =
          sent && board.room->replace(nullptr, kFirst, kSecondBytes, kSecondBytes, Nothing{});
      whole = !board.home_flash.dark() && !board.other_flash.dark();
      for (const std::uint32_t again : {writes % 40, writes % 7}) {
        board.home_flash.power_up();
        board.other_flash.power_up();
        board.home_flash.cut_after(again);
        store::finish_waiting(board.home, board.other, Nothing{});
      }
      board.start();
      EXPECT_TRUE(board.holds(0, 0) || board.holds(0, 1)) << at_home << ' ' << writes;
      EXPECT_TRUE(!replaced || board.holds(0, 1)) << at_home << ' ' << writes;
      EXPECT_EQ(board.kept(), 1) << at_home << ' ' << writes;
      ++(board.holds(0, 1) ? new_ones : old_ones);
      EXPECT_TRUE(board.send(2)) << "it takes others all the same";
    }
  }
  EXPECT_GT(old_ones, 10);
  EXPECT_GT(new_ones, 10);
}

TEST(SharedPage, WhatTheMemoryDoesNotTakeLeavesHomeAsItWas) {
  Board board;
  board.other_flash.refuse(1);
  EXPECT_FALSE(board.send(1));
  ASSERT_TRUE(board.send(1)) << "the next one may be taken";
  board.other_flash.refuse(1);
  EXPECT_FALSE(board.room->replace(nullptr, kFirst, kSecondBytes, kSecondBytes, Nothing{}));
  EXPECT_TRUE(board.holds(0, 0));
  board.start();
  EXPECT_TRUE(board.holds(0, 0));
}

TEST(SharedPage, ErasesOnceForEachNewOneAndOnlyWhenItMay) {
  Board board;
  const std::uint32_t before = board.other_flash.erases();
  for (std::uint32_t times = 1; times <= 2; ++times) {
    board.room->begin();
    board.room->work(false);
    EXPECT_FALSE(board.room->ready());
    EXPECT_EQ(board.other_flash.erases(), before + times - 1);
    board.room->work(true);
    EXPECT_TRUE(board.room->ready());
    EXPECT_EQ(board.other_flash.erases(), before + times);
    board.room->begin();
    EXPECT_TRUE(board.room->ready()) << "blank by now";
    ASSERT_TRUE(board.room->write(0, Second(1).byte, 9));
  }
}

TEST(SharedPage, ThatCannotBeErasedIsTold) {
  Board board;
  board.other_flash.cut_after(0);  // needs power to erase
  EXPECT_FALSE(board.send(1));
  EXPECT_TRUE(board.room->ready());
  board.room->begin();
  EXPECT_FALSE(board.room->write(0, Second(1).byte, 8)) << "not: ask again";
  board.other_flash.power_up();
  EXPECT_TRUE(board.send(1)) << "the next one tries again";
}

TEST(SharedPage, TheLogComesFirst) {
  Board board;
  ASSERT_TRUE(board.send(1));
  std::uint8_t value = 1;
  while (board.log.lent() && value < 200) board.keep(++value);
  EXPECT_FALSE(board.log.lent());
  EXPECT_EQ(board.kept(), value);
  EXPECT_FALSE(board.room->write(0, Second(1).byte, 1)) << "its page is the log's";
  EXPECT_FALSE(board.room->replace(nullptr, kFirst, kSecondBytes, 0, Nothing{}));
  EXPECT_TRUE(board.holds(0, 0));
  EXPECT_TRUE(board.send(2)) << "in the other one now";
  EXPECT_TRUE(board.room->replace(nullptr, kFirst, kSecondBytes, 0, Nothing{}));
  EXPECT_TRUE(board.holds(0, 2));
  board.start();
  EXPECT_EQ(board.kept(), value);
  EXPECT_EQ(board.misuses(), 0u);
}

TEST(SharedPage, IsFoundBesideALogThatMoves) {
  for (int steps = 0; steps < 8; ++steps) {
    Board board;
    std::uint8_t value = 1;
    while (board.log.free_bytes() >= 32) board.keep(++value);
    ASSERT_EQ(board.log.put(kKey, &++value, 1), hal::PutResult::kAccepted);
    for (int i = 0; i < steps; ++i) board.log.work(true);
    ASSERT_TRUE(board.send(1)) << steps;
    for (int i = 0; i < 100; ++i) board.log.work(true);
    EXPECT_EQ(board.kept(), value) << steps;
    const bool replaced = board.room->replace(nullptr, kFirst, kSecondBytes, 0, Nothing{});
    EXPECT_EQ(replaced, board.log.lent()) << steps;
    board.start();
    EXPECT_TRUE(board.holds(0, replaced ? 1 : 0)) << steps;
    EXPECT_EQ(board.kept(), value) << steps;
  }
}

TEST(SharedPage, ThereIsNoMoreRoomThanInBothPages) {
  Board board;
  EXPECT_EQ(board.room->room(), kRoom);
  const Board::Room wide(board.home, 128, 5000, board.other, board.log);
  EXPECT_EQ(wide.room(), 512u - store::kBehindNote - 128);
}

}  // namespace
}  // namespace verp
