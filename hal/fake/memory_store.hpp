#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/store.hpp"

/// A volatile Store, for boards without spare flash and for tests.
namespace verp::hal {

class MemoryStore {
 public:
  static constexpr std::size_t kMaxKeys = 16;
  static constexpr std::size_t kMaxValue = 256;

  std::size_t get(std::uint16_t key, std::uint8_t* to, std::size_t capacity) const {
    for (const Value& value : value_) {
      if (value.key != key || value.size == 0) continue;
      for (std::size_t i = 0; i < value.size && i < capacity; ++i) to[i] = value.bytes[i];
      return value.size;
    }
    return 0;
  }

  PutResult put(std::uint16_t key, const std::uint8_t* from, std::size_t size) {
    if (key == 0 || key == kNoKey) return PutResult::kBadKey;
    if (pending_) return PutResult::kBusy;
    Value* place = find(key);
    if (place == nullptr && size > 0) place = find(0);
    if (size > kMaxValue || (place == nullptr && size > 0)) return PutResult::kNoRoom;
    if (place == nullptr) return PutResult::kAccepted;
    next_.key = size > 0 ? key : std::uint16_t{0};
    next_.size = size;
    for (std::size_t i = 0; i < size; ++i) next_.bytes[i] = from[i];
    place_ = place;
    pending_ = true;
    return PutResult::kAccepted;
  }

  WorkState work(bool) {
    if (pending_) *place_ = next_;
    pending_ = false;
    return WorkState::kIdle;
  }

 private:
  struct Value {
    std::uint16_t key = 0;  ///< 0: free
    std::size_t size = 0;
    std::uint8_t bytes[kMaxValue] = {};
  };
  Value* find(std::uint16_t key) {
    for (Value& value : value_) {
      if (value.key == key) return &value;
    }
    return nullptr;
  }

  Value value_[kMaxKeys];
  Value next_;
  Value* place_ = nullptr;
  bool pending_ = false;
};

static_assert(Store<MemoryStore>);

}  // namespace verp::hal
