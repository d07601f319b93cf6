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

/// The last tick's State and some earlier records as images beside `images`'. Holding freezes them
/// while the loop goes on, so that a client can read a walking robot's bits.
///
/// ImageKind::kState is a HeldTick, available while held. kTicks are kTicks TickRecords; tick n is
/// at n modulo kTicks; an unwritten one has chain 0. A record may change while it is read, unless
/// held.
class TickLog final : public Images {
 public:
  static constexpr std::size_t kTicks = 16;

  explicit TickLog(Images& images) : images_(images) {}

  /// Call at the end of each tick.
  void keep(const TickRecord& record, const State& state) override;
  /// Values of register tick_hold.
  enum Hold : std::uint8_t { kNothing = 0, kStateOnly = 1, kAll = 2 };
  void hold(std::uint8_t what) override { hold_ = what; }

  bool keeps_ticks() const override { return true; }

  // Images
  std::size_t size(ImageKind kind) const override;
  std::size_t room(ImageKind kind) const override { return is_log(kind) ? 0 : images_.room(kind); }
  void read(ImageKind kind, std::size_t offset, std::uint8_t* to, std::size_t count) const override;
  void begin(ImageKind kind) override;
  Taken write(ImageKind kind, std::size_t offset, const std::uint8_t* from,
              std::size_t count) override;
  std::uint8_t commit(ImageKind kind, std::uint32_t crc) override;

 private:
  static bool is_log(ImageKind kind);

  Images& images_;
  HeldTick last_;
  TickRecord ring_[kTicks];
  bool any_ = false;
  std::uint8_t hold_ = kNothing;
};

}  // namespace verp::app
