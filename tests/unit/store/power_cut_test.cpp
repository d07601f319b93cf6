#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/store/flash_store.hpp"
#include "hal/fake/fake_flash.hpp"

// A power cut may come at any write, even within a word or an erase.

namespace verp {
namespace {

constexpr std::size_t kPage = 512;
constexpr std::size_t kKeys = 6;
constexpr std::size_t kMaxValue = 40;
constexpr int kUpdates = 1000;

struct Random {
  std::uint32_t state = 0x2545F491u;
  std::uint32_t operator()(std::uint32_t below) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (state >> 4) % below;
  }
};

struct Value {
  std::size_t size = 0;
  std::uint8_t bytes[kMaxValue] = {};
  bool operator==(const Value& other) const {
    if (size != other.size) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (bytes[i] != other.bytes[i]) return false;
    }
    return true;
  }
};

struct Update {
  std::uint16_t key = 1;
  Value value;
};

Update random_update(Random& random) {
  Update update;
  update.key = static_cast<std::uint16_t>(1 + random(kKeys));
  update.value.size = random(8) == 0 ? 0 : random(kMaxValue + 1);
  const bool blank = random(8) == 0;  // looks erased
  for (std::size_t i = 0; i < update.value.size; ++i) {
    update.value.bytes[i] = blank ? std::uint8_t{0xFF} : static_cast<std::uint8_t>(random(256));
  }
  return update;
}

template <class Store>
Value value_of(const Store& store, std::uint16_t key) {
  Value value;
  value.size = store.get(key, value.bytes, kMaxValue);
  return value;
}

template <class Flash>
using StoreOf = store::FlashStore<Flash, kKeys, kMaxValue>;

/// False if the power failed or the flash gave up.
template <class Store>
bool apply(Store& store, const Update& update, bool may_erase = true) {
  if (store.put(update.key, update.value.bytes, update.value.size) != hal::PutResult::kAccepted) {
    return false;
  }
  for (int i = 0; i < 200; ++i) {
    const hal::WorkState state = store.work(may_erase);
    if (state == hal::WorkState::kIdle) return true;
    if (state == hal::WorkState::kFailed) return false;
  }
  return false;
}

/// Every other key keeps its value, at the next start too. `became` gets the updated one.
template <class Flash>
bool is_sound_after_cut(Flash& flash, const Value (&expected)[kKeys + 1], const Update& update,
                        Value& became) {
  flash.power_up();
  StoreOf<Flash> found(flash);
  found.open();
  became = value_of(found, update.key);
  bool sound = became == expected[update.key] || became == update.value;
  flash.power_up();
  StoreOf<Flash> again(flash);
  again.open();
  sound = sound && value_of(again, update.key) == became && again.damaged() == 0;
  for (std::uint16_t key = 1; key <= kKeys; ++key) {
    sound = sound && (key == update.key || value_of(again, key) == expected[key]);
  }
  return sound;
}

/// Each time from the same state, cut one write later.
template <std::size_t kUnit>
void cut_at_every_write(int updates) {
  using Flash = hal::FakeFlash<kPage, kUnit>;
  static Flash before;
  static Flash flash;
  static Value expected[kKeys + 1];
  before = Flash(7);
  for (Value& value : expected) value = Value{};
  Random random;
  for (int i = 0; i < updates; ++i) {
    const Update update = random_update(random);
    bool through = false;
    for (std::uint32_t cut = 0; !through; ++cut) {
      flash = before;
      StoreOf<Flash> store(flash);
      store.open();
      flash.cut_after(cut);
      through = apply(store, update) && !flash.dark();
      ASSERT_LT(cut, 2000u);
      Value became = update.value;
      const bool sound = through ? value_of(store, update.key) == update.value
                                 : is_sound_after_cut(flash, expected, update, became);
      ASSERT_TRUE(sound) << "update " << i << ", cut at write " << cut;
    }
    before = flash;
    before.power_up();
    expected[update.key] = update.value;
  }
  EXPECT_EQ(before.misuses(), 0u);
  EXPECT_GT(before.erases(), static_cast<std::uint32_t>(updates / 40));
}

TEST(PowerCut, AtEveryWriteLeavesTheOldOrTheNewValue) {
  cut_at_every_write<4>(kUpdates);
}

TEST(PowerCut, AtEveryWriteOfBytesHalfWordsAndDoubleWords) {
  cut_at_every_write<1>(kUpdates / 20);
  cut_at_every_write<2>(kUpdates / 20);
  cut_at_every_write<8>(kUpdates / 10);
}

// Also during recovery: doubts must not add up.
template <std::size_t kUnit>
void cut_after_cut() {
  using Flash = hal::FakeFlash<kPage, kUnit>;
  static Flash flash(11);
  static Value expected[kKeys + 1];
  Random random;
  int cuts = 0;
  for (int i = 0; i < 2 * kUpdates; ++i) {
    const Update update = random_update(random);
    for (int boots = static_cast<int>(random(4)); boots > 0; --boots) {
      flash.cut_after(random(12));
      StoreOf<Flash> interrupted(flash);
      interrupted.open();
      flash.power_up();
    }
    StoreOf<Flash> store(flash);
    store.open();
    flash.cut_after(random(60));
    const bool through = apply(store, update);
    cuts += flash.dark() ? 1 : 0;
    Value became;
    ASSERT_TRUE(is_sound_after_cut(flash, expected, update, became)) << "update " << i;
    ASSERT_TRUE(!through || became == update.value) << "update " << i;
    expected[update.key] = became;
  }
  EXPECT_GT(cuts, kUpdates / 4);
  EXPECT_EQ(flash.misuses(), 0u);
}

TEST(PowerCut, AfterPowerCutLosesNothing) {
  cut_after_cut<1>();
  cut_after_cut<4>();
  cut_after_cut<8>();
}

// A start that read it as whole would lose later updates.
TEST(PowerCut, NoHalfMadePageComesBack) {
  using Flash = hal::FakeFlash<kPage, 4>;
  using Store = StoreOf<Flash>;
  static Flash flash;
  Update filler;
  filler.value.size = kMaxValue;
  Update late;
  late.key = 2;
  late.value.size = 4;
  for (std::uint32_t i = 0; i < 1500; ++i) {
    flash = Flash(i);
    {
      Store store(flash);
      store.open();
      while (store.free_bytes() == 0 || store.free_bytes() >= kPage / 4) {
        filler.value.bytes[0] = static_cast<std::uint8_t>(filler.value.bytes[0] + 1);
        ASSERT_TRUE(apply(store, filler));
      }
      flash.cut_after(i % 30);
      for (int step = 0; step < 30; ++step) store.work(true);
    }
    for (int boot = 0; boot < 3; ++boot) {
      flash.power_up();
      Store store(flash);
      store.open();
      late.value.bytes[0] = static_cast<std::uint8_t>(boot);
      ASSERT_TRUE(apply(store, late, false)) << "run " << i;
      flash.power_up();
      Store found(flash);
      found.open();
      ASSERT_TRUE(value_of(found, late.key) == late.value) << "run " << i << ", start " << boot;
      ASSERT_TRUE(value_of(found, filler.key) == filler.value) << "run " << i;
    }
  }
}

}  // namespace
}  // namespace verp
