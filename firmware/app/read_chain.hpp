#pragma once
#include <cstdint>

namespace verp::app {

/// One Sync Read's devices in reply order. A silent device may silence those behind it, so the
/// first device missed moves to the end.
template <int kCapacity>
class ReadChain {
 public:
  void add(std::uint8_t id, std::uint8_t slot) {
    id_[count_] = id;
    slot_[count_] = slot;
    ++count_;
  }
  int count() const { return count_; }
  const std::uint8_t* ids() const { return id_; }
  void set_id(std::uint8_t slot, std::uint8_t id) {
    for (int i = 0; i < count_; ++i) id_[i] = slot_[i] == slot ? id : id_[i];
  }

  void begin() { next_ = 0, missed_ = -1; }
  /// The slot of this reply; -1: no device due has this id.
  int match(std::uint8_t id) {
    for (int i = next_; i < count_; ++i) {
      if (id_[i] != id) continue;
      if (i > next_) note_missed();
      next_ = i + 1;
      return slot_[i];
    }
    return -1;
  }
  bool ended() const { return next_ == count_; }
  /// Call after the read. True if all answered.
  bool complete() {
    if (next_ < count_) note_missed();
    if (missed_ < 0) return true;
    const std::uint8_t id = id_[missed_];
    const std::uint8_t slot = slot_[missed_];
    for (int i = missed_; i + 1 < count_; ++i) {
      id_[i] = id_[i + 1];
      slot_[i] = slot_[i + 1];
    }
    id_[count_ - 1] = id;
    slot_[count_ - 1] = slot;
    return false;
  }

 private:
  void note_missed() { missed_ = missed_ < 0 ? next_ : missed_; }
  std::uint8_t id_[kCapacity] = {};
  std::uint8_t slot_[kCapacity] = {};
  int count_ = 0;
  int next_ = 0;
  int missed_ = -1;
};

}  // namespace verp::app
