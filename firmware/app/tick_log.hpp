#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/control/state.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/block_window.hpp"

namespace verp::app {

struct HeldTick {
  TickRecord record;
  State state;  ///< the State after it
  VERP_FIELDS(record, state)
};
VERP_PACKED(HeldTick);

/// The last tick's State and some earlier records as images beside `Store`'s. Holding freezes them
/// while the loop goes on, so that a client can read a walking robot's bits.
///
/// ImageKind::kState is a HeldTick, available while held. kTicks are kTicks TickRecords; tick n is
/// at n modulo kTicks; an unwritten one has chain 0. A record may change while it is read, unless
/// held.
template <Images Store = NoImages>
class TickLog {
 public:
  static constexpr std::size_t kTicks = 16;

  explicit TickLog(Store& images) : images_(images) {}

  /// Call at the end of each tick.
  void keep(const TickRecord& record, const State& state) {
    if (hold_ == kAll) return;
    ring_[record.inputs.tick % kTicks] = record;
    any_ = true;
    if (hold_ != kNothing) return;
    last_.record = record;
    last_.state = state;
  }
  /// Values of register tick_hold.
  enum Hold : std::uint8_t { kNothing = 0, kStateOnly = 1, kAll = 2 };
  void hold(std::uint8_t what) { hold_ = what; }

  // Images
  std::size_t size(ImageKind kind) const {
    if (kind == ImageKind::kState) return hold_ != kNothing && any_ ? sizeof last_ : 0;
    if (kind == ImageKind::kTicks) return any_ ? sizeof ring_ : 0;
    return images_.size(kind);
  }
  std::size_t room(ImageKind kind) const { return is_log(kind) ? 0 : images_.room(kind); }
  void read(ImageKind kind, std::size_t offset, std::uint8_t* to, std::size_t count) const {
    if (kind == ImageKind::kState) {
      __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(&last_) + offset, count);
    } else if (kind == ImageKind::kTicks) {
      __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(ring_) + offset, count);
    } else {
      images_.read(kind, offset, to, count);
    }
  }
  void begin(ImageKind kind) {
    if (!is_log(kind)) images_.begin(kind);
  }
  Taken write(ImageKind kind, std::size_t offset, const std::uint8_t* from, std::size_t count) {
    return is_log(kind) ? Taken::kNo : images_.write(kind, offset, from, count);
  }
  std::uint8_t commit(ImageKind kind, std::uint32_t crc) {
    return is_log(kind) ? kWrongWindowCrc : images_.commit(kind, crc);
  }

 private:
  static bool is_log(ImageKind kind) {
    return kind == ImageKind::kState || kind == ImageKind::kTicks;
  }

  Store& images_;
  HeldTick last_;
  TickRecord ring_[kTicks];
  bool any_ = false;
  std::uint8_t hold_ = kNothing;
};

static_assert(Images<TickLog<>>);

template <class Store>
concept KeepsTicks = requires(Store& store, const TickRecord& record, const State& state) {
  store.keep(record, state);
  store.hold(std::uint8_t{1});
};

}  // namespace verp::app
