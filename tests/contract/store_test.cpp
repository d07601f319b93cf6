#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "hal/contract/store.hpp"
#include "tests/contract/backends.hpp"

// hal/contract/store.hpp. tests/unit/store tests power cuts.

namespace verp {
namespace {

using hal::PutResult;
using hal::WorkState;
using Bytes = std::vector<std::uint8_t>;

template <class Backend>
class StoreContract : public ::testing::Test {
 protected:
  WorkState settle() {
    WorkState state = WorkState::kWorking;
    for (int i = 0; i < 1000 && state == WorkState::kWorking; ++i) state = store.work(true);
    return state;
  }
  PutResult put(std::uint16_t key, const Bytes& value) {
    return store.put(key, value.data(), value.size());
  }
  Bytes get(std::uint16_t key) const {
    Bytes value(1024);
    value.resize(store.get(key, value.data(), value.size()));
    return value;
  }
  Backend backend;
  decltype(backend.store)& store = backend.store;
};

TYPED_TEST_SUITE(StoreContract, test::Stores);

TYPED_TEST(StoreContract, ModelsTheConcept) {
  static_assert(hal::Store<decltype(TypeParam::store)>);
}

TYPED_TEST(StoreContract, HasNothingAtFirst) {
  for (const int key : {1, 2, 1000, 0xFFFE}) {
    EXPECT_TRUE(this->get(static_cast<std::uint16_t>(key)).empty());
  }
  EXPECT_EQ(this->store.work(false), WorkState::kIdle);
}

TYPED_TEST(StoreContract, IsAMap) {
  std::mt19937 random(3);
  std::map<std::uint16_t, Bytes> expected;
  for (int i = 0; i < 2000; ++i) {
    const auto key = static_cast<std::uint16_t>(1 + random() % 8);
    Bytes value(random() % 4 == 0 ? 0 : random() % 100);
    for (auto& byte : value) byte = static_cast<std::uint8_t>(random());
    ASSERT_EQ(this->put(key, value), PutResult::kAccepted);
    ASSERT_EQ(this->settle(), WorkState::kIdle);
    expected[key] = value;
    for (const auto& [other, bytes] : expected)
      ASSERT_EQ(this->get(other), bytes) << "update " << i;
  }
}

TYPED_TEST(StoreContract, KeepsTheOldValueUntilTheNewOneIsDurable) {
  ASSERT_EQ(this->put(5, {1, 2, 3}), PutResult::kAccepted);
  ASSERT_EQ(this->settle(), WorkState::kIdle);
  const Bytes long_value(250, 7);
  ASSERT_EQ(this->put(5, long_value), PutResult::kAccepted);
  WorkState state = WorkState::kWorking;
  while (state == WorkState::kWorking) {
    EXPECT_EQ(this->get(5), (Bytes{1, 2, 3}));
    EXPECT_EQ(this->put(6, {1}), PutResult::kBusy);
    state = this->store.work(true);
  }
  EXPECT_EQ(state, WorkState::kIdle);
  EXPECT_EQ(this->get(5), long_value);
  EXPECT_EQ(this->put(6, {1}), PutResult::kAccepted);
}

TYPED_TEST(StoreContract, TakesItsOwnCopy) {
  Bytes value = {1, 2, 3};
  ASSERT_EQ(this->put(1, value), PutResult::kAccepted);
  value = {9, 9, 9};
  this->settle();
  EXPECT_EQ(this->get(1), (Bytes{1, 2, 3}));
}

TYPED_TEST(StoreContract, CopiesNoMoreThanFitsAndTellsTheWholeSize) {
  this->put(1, {1, 2, 3, 4});
  this->settle();
  std::uint8_t buffer[3] = {0, 0, 77};
  EXPECT_EQ(this->store.get(1, buffer, 2), 4u);
  EXPECT_EQ(buffer[1], 2);
  EXPECT_EQ(buffer[2], 77);
}

TYPED_TEST(StoreContract, RefusesWhatIsNoKeyOrFindsNoRoom) {
  EXPECT_EQ(this->put(0, {1}), PutResult::kBadKey);
  EXPECT_EQ(this->put(0xFFFF, {1}), PutResult::kBadKey);
  EXPECT_EQ(this->put(1, Bytes(5000)), PutResult::kNoRoom);
  PutResult result = PutResult::kAccepted;
  std::uint16_t key = 0;
  while (result == PutResult::kAccepted && key < 1000) {
    result = this->put(++key, Bytes(200, 5));
    this->settle();
  }
  EXPECT_EQ(result, PutResult::kNoRoom);
  for (std::uint16_t kept = 1; kept < key; ++kept) EXPECT_EQ(this->get(kept), Bytes(200, 5));
  EXPECT_EQ(this->put(1, {}), PutResult::kAccepted);
  EXPECT_EQ(this->settle(), WorkState::kIdle);
  EXPECT_TRUE(this->get(1).empty());
}

}  // namespace
}  // namespace verp
