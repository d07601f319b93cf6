#pragma once
#include <cstdint>

#include "common/protocol/canopen/sdo_client.hpp"
#include "common/protocol/canopen/sdo_server.hpp"

namespace verp::canopen::test {

struct Line {
  bool request;
  std::uint8_t bytes[8];
};

inline Frame frame_of(const Line& line) {
  Frame frame = classic_frame(line.request ? 0x602 : 0x582, 8);
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = line.bytes[i];
  return frame;
}

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 1664525u + 1013904223u;
    return (state_ >> 8) % limit;
  }
  bool one_in(std::uint32_t chance) { return chance != 0 && below(chance) == 0; }

 private:
  std::uint32_t state_;
};

/// 2000h: up to 100 bytes, whole. 3000h: up to kLarge bytes, in pieces. 2001h: read only, 4 bytes.
/// 2002h: write only, 2 to 4 bytes.
struct BenchDictionary {
  static constexpr std::uint32_t kSmall = 100;
  static constexpr std::uint32_t kLarge = 2000;

  struct Value {
    std::uint8_t* bytes = nullptr;
    std::uint32_t size = 0;
  };

  Value* at_index(std::uint16_t index) {
    large.bytes = large_bytes;
    if (index == 0x3000) return &large;
    if (index < 0x2000 || index > 0x2002) return nullptr;
    small[index - 0x2000].bytes = small_bytes[index - 0x2000];
    return &small[index - 0x2000];
  }
  Abort find(Address at, Entry& entry) {
    const Value* value = at_index(at.index);
    if (value == nullptr) return Abort::kNoObject;
    if (at.subindex != 0) return Abort::kNoSubindex;
    entry = {at.index != 0x2002, at.index != 0x2001, value->size, 0, kSmall};
    if (at.index == 0x2002) entry.min_size = 2, entry.max_size = 4;
    if (at.index == 0x3000) entry.max_size = kLarge;
    return Abort::kNone;
  }
  Abort read(Address at, std::uint32_t offset, std::uint8_t* buffer, std::uint32_t size) {
    const Value& value = *at_index(at.index);
    if (offset + size > value.size) ++misuses;
    for (std::uint32_t i = 0; i < size; ++i) buffer[i] = value.bytes[offset + i];
    return Abort::kNone;
  }
  Abort write(Address at, const std::uint8_t* data, std::uint32_t size) {
    Value& value = *at_index(at.index);
    if (size > kSmall || at.index == 0x3000) return ++misuses, Abort::kGeneral;
    if (at.index == 0x2002 && (size < 2 || size > 4)) ++misuses;
    for (std::uint32_t i = 0; i < size; ++i) value.bytes[i] = data[i];
    value.size = size;
    ++writes;
    return Abort::kNone;
  }
  Abort write_part(Address at, std::uint32_t offset, const std::uint8_t* data, std::uint32_t size) {
    if (offset == 0) incoming = 0;
    if (at.index != 0x3000 || offset != incoming || offset + size > kLarge) {
      return ++misuses, Abort::kGeneral;
    }
    for (std::uint32_t i = 0; i < size; ++i) incoming_bytes[offset + i] = data[i];
    incoming += size;
    return Abort::kNone;
  }
  Abort write_done(Address, std::uint32_t size) {
    if (size != incoming) ++misuses;
    for (std::uint32_t i = 0; i < size; ++i) large_bytes[i] = incoming_bytes[i];
    large.size = size;
    ++writes;
    return Abort::kNone;
  }

  Value small[3];
  Value large;
  std::uint32_t incoming = 0;
  std::uint8_t small_bytes[3][kSmall] = {};
  std::uint8_t large_bytes[kLarge] = {};
  std::uint8_t incoming_bytes[kLarge] = {};
  int writes = 0;
  int misuses = 0;  ///< calls against the contract
};
static_assert(StreamingDictionary<BenchDictionary>);

/// Frames of one identifier never overtake each other on CAN, but gateways and drivers reorder
/// them; `swap` allows it.
class Channel {
 public:
  std::uint32_t lose = 0;       ///< one frame in `lose`; 0: none
  std::uint32_t duplicate = 0;  ///< one in so many arrives twice
  std::uint32_t swap = 0;       ///< one in so many overtakes another

  void push(const Frame& frame, Dice& dice) {
    if (dice.one_in(lose)) return;
    const int copies = dice.one_in(duplicate) ? 2 : 1;
    for (int i = 0; i < copies && size_ < kCapacity; ++i) {
      const std::uint32_t at = size_ > 0 && dice.one_in(swap) ? dice.below(size_) : size_;
      for (std::uint32_t k = size_; k > at; --k) frames_[k] = frames_[k - 1];
      frames_[at] = frame;
      ++size_;
    }
  }
  bool has_room() const { return size_ + 2 <= kCapacity; }
  bool pop(Frame& frame) {
    if (size_ == 0) return false;
    frame = frames_[0];
    --size_;
    for (std::uint32_t i = 0; i < size_; ++i) frames_[i] = frames_[i + 1];
    return true;
  }

 private:
  static constexpr std::uint32_t kCapacity = 16;
  Frame frames_[kCapacity];
  std::uint32_t size_ = 0;
};

struct Bench {
  static constexpr std::uint8_t kNode = 2;
  static constexpr int kMaxSteps = 20'000;
  BenchDictionary dictionary;
  SdoServer<BenchDictionary> server{dictionary, kNode};
  SdoClient client{kNode};
  Channel up;
  Channel down;
  std::uint64_t now_us = 0;
  int frames = 0;

  void reset() {
    dictionary = BenchDictionary();
    server.reset();
    client = SdoClient(kNode);
    up = down = Channel();
    now_us = 0;
    frames = 0;
  }
  bool step(Dice& dice) {
    Frame frame;
    bool moved = false;
    // A sender faster than the wire lets frames overtake.
    const std::uint32_t burst = 1 + dice.below(3);
    for (std::uint32_t i = 0; i < burst && up.has_room() && client.next(frame, now_us);
         ++i, moved = true, ++frames) {
      up.push(frame, dice);
    }
    for (std::uint32_t i = 0; i < burst && down.has_room() && server.next(frame, now_us);
         ++i, moved = true, ++frames) {
      down.push(frame, dice);
    }
    if (up.pop(frame)) server.receive(frame, now_us), moved = true;
    if (down.pop(frame)) client.receive(frame, now_us), moved = true;
    now_us += moved ? 200 : 20'000;
    return moved;
  }
  /// False if the transfer does not end or the bus stays busy.
  bool run(Dice& dice) {
    int steps = 0;
    while (client.state() == SdoClient::State::kBusy) {
      if (++steps > kMaxSteps) return false;
      step(dice);
    }
    while (step(dice)) {
      if (++steps > kMaxSteps) return false;
    }
    return true;
  }
};

inline Bench& fresh_bench() {
  static Bench bench;
  bench.reset();
  return bench;
}

}  // namespace verp::canopen::test
