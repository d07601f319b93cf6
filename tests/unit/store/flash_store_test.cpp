#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/store/flash_store.hpp"
#include "hal/fake/fake_flash.hpp"

namespace verp {
namespace {

using Flash = hal::FakeFlash<512, 4>;
using Store = store::FlashStore<Flash, 4, 64>;
using hal::PutResult;
using hal::WorkState;

constexpr std::uint8_t kValue[64] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

/// Until the store is idle or wants something.
WorkState settle(Store& store, bool may_erase = true) {
  WorkState state = WorkState::kWorking;
  for (int i = 0; i < 100 && state == WorkState::kWorking; ++i) state = store.work(may_erase);
  return state;
}

TEST(FlashStore, NeverProgramsMoreThanItsShareInOneStep) {
  Flash flash;
  Store store(flash);
  store.open();
  constexpr std::uint32_t kShare = (4 + 4) * store::kSlot / Flash::kUnit;
  std::uint8_t value[64] = {};
  for (std::uint8_t round = 0; round < 100; ++round) {
    value[0] = round;
    ASSERT_EQ(store.put(1, value, sizeof value), PutResult::kAccepted);
    for (WorkState state = WorkState::kWorking; state != WorkState::kIdle;) {
      const std::uint32_t programs = flash.programs();
      const std::uint32_t erases = flash.erases();
      state = store.work(true);
      EXPECT_LE(flash.programs() - programs, kShare);
      EXPECT_TRUE(flash.erases() == erases || flash.programs() == programs);
    }
  }
  EXPECT_EQ(flash.misuses(), 0u);
}

TEST(FlashStore, NeverErasesWhileTheTorqueIsOn) {
  Flash flash;
  Store store(flash);
  store.open();
  std::uint8_t value[64] = {};
  EXPECT_EQ(store.put(1, value, sizeof value), PutResult::kAccepted);
  EXPECT_EQ(settle(store, false), WorkState::kNeedsErase);
  EXPECT_EQ(flash.erases(), 0u);
  EXPECT_EQ(settle(store, true), WorkState::kIdle);
  const std::uint32_t erases = flash.erases();
  WorkState state = WorkState::kIdle;
  for (std::uint8_t round = 1; round < 50 && state == WorkState::kIdle; ++round) {
    value[0] = round;
    ASSERT_EQ(store.put(1, value, sizeof value), PutResult::kAccepted);
    state = settle(store, false);
  }
  EXPECT_EQ(state, WorkState::kNeedsErase);
  EXPECT_EQ(flash.erases(), erases);
  std::uint8_t old[64];
  EXPECT_EQ(store.get(1, old, sizeof old), sizeof old);
  EXPECT_EQ(old[0] + 1, value[0]);
  EXPECT_EQ(settle(store, true), WorkState::kIdle);
  store.get(1, old, sizeof old);
  EXPECT_EQ(old[0], value[0]);
}

TEST(FlashStore, MakesRoomBeforeItIsNeeded) {
  Flash flash;
  Store store(flash);
  store.open();
  std::uint8_t value[64] = {};
  for (std::uint8_t round = 1; round < 30; ++round) {
    value[0] = round;
    ASSERT_EQ(store.put(1, value, sizeof value), PutResult::kAccepted);
    EXPECT_EQ(settle(store), WorkState::kIdle);
    EXPECT_EQ(settle(store), WorkState::kIdle);
    EXPECT_GE(store.free_bytes(), 512u / 4);
  }
}

TEST(FlashStore, AnUnchangedValueCostsNothing) {
  Flash flash;
  Store store(flash);
  store.open();
  store.put(7, kValue, 12);
  EXPECT_EQ(settle(store), WorkState::kIdle);
  const std::uint32_t programs = flash.programs();
  EXPECT_EQ(store.put(7, kValue, 12), PutResult::kAccepted);
  EXPECT_EQ(settle(store), WorkState::kIdle);
  EXPECT_EQ(flash.programs(), programs);
}

TEST(FlashStore, AFullStoreKeepsWhatItHasAndCanBeEmptied) {
  Flash flash;
  Store store(flash);
  store.open();
  for (std::uint16_t key = 1; key <= 4; ++key) {
    EXPECT_EQ(store.put(key, kValue, 64), PutResult::kAccepted);
    EXPECT_EQ(settle(store), WorkState::kIdle);
  }
  EXPECT_EQ(store.put(5, kValue, 1), PutResult::kNoRoom);
  EXPECT_EQ(store.put(1, kValue, 65), PutResult::kNoRoom);
  for (std::uint16_t key = 1; key <= 4; ++key) {
    EXPECT_EQ(store.get(key, nullptr, 0), 64u);
    EXPECT_EQ(store.put(key, nullptr, 0), PutResult::kAccepted);
    EXPECT_EQ(settle(store), WorkState::kIdle);
    EXPECT_EQ(store.get(key, nullptr, 0), 0u);
  }
  EXPECT_EQ(store.put(5, kValue, 1), PutResult::kAccepted);
}

// A refused word costs its place, not a value.
TEST(FlashStore, SurvivesFlashThatRefuses) {
  for (std::uint32_t refusals = 1; refusals < 6; ++refusals) {
    Flash flash(refusals);
    Store store(flash);
    store.open();
    store.put(3, kValue, 12);
    EXPECT_EQ(settle(store), WorkState::kIdle);
    flash.refuse(refusals);
    ASSERT_EQ(store.put(3, kValue + 4, 8), PutResult::kAccepted);
    const WorkState state = settle(store);
    EXPECT_TRUE(state == WorkState::kIdle || state == WorkState::kFailed);
    EXPECT_EQ(store.get(3, nullptr, 0), state == WorkState::kIdle ? 8u : 12u);
    flash.refuse(0);
    ASSERT_EQ(store.put(2, kValue, 5), PutResult::kAccepted);
    EXPECT_EQ(settle(store), WorkState::kIdle);
    Store found(flash);
    found.open();
    EXPECT_EQ(found.get(3, nullptr, 0), store.get(3, nullptr, 0));
    EXPECT_EQ(found.get(2, nullptr, 0), 5u);
  }
}

TEST(FlashStore, AFlippedBitCostsOneRecordAtMost) {
  for (std::size_t offset = sizeof(store::PageHeader); offset < 112; ++offset) {
    Flash flash;
    Store store(flash);
    store.open();
    for (std::uint16_t key = 1; key <= 4; ++key) {
      store.put(key, kValue + key, 16);
      settle(store);
    }
    flash.damage(0, offset, static_cast<std::uint8_t>(1u << offset % 8));
    Store found(flash);
    found.open();
    int lost = 0;
    for (std::uint16_t key = 1; key <= 4; ++key) {
      std::uint8_t value[16] = {};
      const std::size_t size = found.get(key, value, sizeof value);
      lost += size == 0 ? 1 : 0;
      for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(value[i], kValue[key + i]);
    }
    EXPECT_EQ(lost, 1) << "byte " << offset;
    EXPECT_TRUE(found.damaged() == 1 || offset >= 88) << "byte " << offset;
  }
}

TEST(FlashStore, PagesWithoutALogAreAnEmptyStore) {
  Flash flash;
  for (std::size_t i = 0; i < 512; ++i) flash.damage(i % 2, i, static_cast<std::uint8_t>(i * 37));
  Store store(flash);
  store.open();
  EXPECT_EQ(store.get(1, nullptr, 0), 0u);
  store.put(1, kValue, 12);
  EXPECT_EQ(settle(store), WorkState::kIdle);
  EXPECT_EQ(store.get(1, nullptr, 0), 12u);
}

}  // namespace
}  // namespace verp
