#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/control/state.hpp"
#include "common/model/image.hpp"
#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/lockstep_messages.hpp"
#include "hal/contract/byte_link.hpp"
#include "hal/contract/frame_bus.hpp"

namespace verp::app {

/// Link errors; all were corrected except `damaged`.
struct LockstepCounters {
  std::uint32_t repeats = 0;
  std::uint32_t spoilt = 0;   ///< incomplete answers
  std::uint32_t damaged = 0;  ///< polls whose frames arrived damaged
};

inline lockstep::Hello hello_of(const Params& params) {
  return {.core_version = kCoreVersion,
          .params_size = sizeof(Params),
          .params_crc = params_crc(params),
          .record_size = sizeof(TickRecord),
          .state_size = sizeof(State)};
}

/// While a controller waits for the twin: feeds its watchdog, serves its operator. Called at least
/// every LockstepBus::kLongSlice_us while nothing arrives. False: stop waiting; the bus is then
/// lost.
template <class Idle>
concept IdleHook = requires(Idle& idle) {
  { idle() } -> std::same_as<bool>;
};

/// The controller's end of lockstep_messages.hpp: a FrameBus in the twin's time. Call greet()
/// first. A slow, paused or unplugged PC makes it wait as long as `idle` allows, without a timeout.
template <std::derived_from<hal::ByteLink> Link, IdleHook Idle>
class LockstepBus final : public hal::FrameBus {
 public:
  /// Longest wait of one link read: at first, and after kEager_us without data. A clock that wakes
  /// every millisecond stretches short waits, which add up.
  static constexpr std::uint32_t kSlice_us = 100;
  static constexpr std::uint32_t kLongSlice_us = 1000;

  LockstepBus(Link& link, Idle idle) : link_(link), idle_(idle) {}

  /// Announces lockstep and this robot; waits for the twin's answer. After a loss bus time restarts
  /// with the twin, and the controller needs a new bring-up.
  lockstep::Verdict greet(const Params& params) {
    lost_ = true;
    answer_ = {};
    used_ = 0;
    sieve_.forget();
    lockstep::HelloReply reply;
    request_size_ = encode(lockstep::kHelloAddress, hello_of(params));
    if (!flush() || !ask(reply, nullptr, 0)) return lockstep::Verdict::kNoAnswer;
    lost_ = reply.verdict != lockstep::Verdict::kAccepted;
    return reply.verdict;
  }

  /// The twin wants no further tick, or is gone.
  bool stopped() const { return lost_ || over(); }
  /// True before greet(), after a refusal, after `idle` gave up, or when the twin restarted: call
  /// greet() again.
  bool lost() const { return lost_; }
  const LockstepCounters& counters() const { return counters_; }

  // Frames leave with the next poll.
  bool send(const std::uint8_t* data, std::size_t size) override {
    if (lost_ || size == 0 || size > hal::kMaxFrame || size > kOutbox - used_) return false;
    __builtin_memcpy(outbox_ + used_, data, size);
    used_ += size;
    return true;
  }

  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    if (lost_) return 0;
    if (capacity > lockstep::kMaxPollBytes) capacity = lockstep::kMaxPollBytes;
    const lockstep::Advance advance{.sequence = ++sequence_,
                                    .capacity = static_cast<std::uint16_t>(capacity),
                                    .timeout_us = timeout_us,
                                    .sent = static_cast<std::uint16_t>(used_),
                                    .sent_crc = dxl::crc16(outbox_, used_)};
    request_size_ = encode(lockstep::kAdvanceAddress, advance);
    lost_ = !flush() || !ask(answer_, buffer, capacity);
    if (lost_) return 0;
    if ((answer_.flags & lockstep::kFrameDamaged) != 0) ++counters_.damaged;
    return answer_.size;
  }

  std::uint64_t now_us() override { return answer_.now_us; }

 private:
  /// The twin sent kStop, maybe in the middle of a tick.
  bool over() const { return (answer_.flags & lockstep::kStop) != 0; }

  static constexpr std::size_t kOutbox = 2 * hal::kMaxFrame;
  static constexpr std::uint32_t kEager_us = 2000;
  static constexpr std::uint32_t kFirstPatience_us = 50'000;
  static constexpr std::uint32_t kLastPatience_us = 1'000'000;
  /// A link that brings more without the answer carries something else.
  static constexpr std::uint32_t kMostBytes = 4 * lockstep::kMaxPollBytes;

  template <class Payload>
  std::size_t encode(std::uint16_t address, const Payload& payload) {
    return dxl::encode_write(outbox_ + used_, lockstep::kMaxClockPacket, lockstep::kClockId,
                             address, reinterpret_cast<const std::uint8_t*>(&payload),
                             sizeof payload);
  }

  bool flush() {
    __builtin_memcpy(request_, outbox_ + used_, request_size_);
    const std::size_t size = used_ + request_size_;
    used_ = 0;
    return write(outbox_, size);
  }

  bool write(const std::uint8_t* from, std::size_t size) {
    while (size > 0) {
      const std::size_t count = link_.write(from, size, kSlice_us);
      from += count;
      size -= count;
      if (count == 0 && (!idle_() || over())) return false;
    }
    return true;
  }

  /// Waits for the answer; repeats request_ as needed. False: given up.
  template <class Reply>
  bool ask(Reply& reply, std::uint8_t* buffer, std::size_t capacity) {
    std::uint32_t patience_us = kFirstPatience_us;
    for (;;) {
      switch (collect(reply, buffer, capacity, patience_us)) {
        case Outcome::kWhole:
          return true;
        case Outcome::kGone:
          return false;
        case Outcome::kSpoilt:
          ++counters_.spoilt;
          break;
        default:
          if (over()) return false;
          patience_us = 2 * patience_us < kLastPatience_us ? 2 * patience_us : kLastPatience_us;
          break;
      }
      ++counters_.repeats;
      if (!idle_() || !write(request_, request_size_)) return false;
    }
  }

  enum class Outcome : std::uint8_t { kNothing, kMore, kWhole, kSpoilt, kGone };

  template <class Reply>
  Outcome collect(Reply& reply, std::uint8_t* buffer, std::size_t capacity,
                  std::uint32_t patience_us) {
    std::size_t count = 0;
    std::uint32_t heard = 0;
    sieve_.forget();
    const auto pass = [&](std::uint8_t byte) {
      if (count < capacity) buffer[count] = byte;
      ++count;
    };
    for (std::uint32_t quiet_us = 0; quiet_us < patience_us && heard < kMostBytes;) {
      const std::uint32_t slice_us = quiet_us < kEager_us ? kSlice_us : kLongSlice_us;
      const std::size_t size = link_.read(chunk_, sizeof chunk_, slice_us);
      heard += static_cast<std::uint32_t>(size);
      if (size == 0) {
        quiet_us += slice_us;
        if (!idle_()) return Outcome::kGone;
      }
      for (std::size_t i = 0; i < size; ++i) {
        if (!sieve_.push(chunk_[i], pass)) continue;
        const Outcome outcome = take(sieve_.packet(), reply, {buffer, count, capacity});
        if (outcome != Outcome::kMore) return outcome;
        count = 0;  // those belonged to another answer
      }
    }
    return Outcome::kNothing;
  }

  // The bytes that preceded a packet of the clock.
  struct Brought {
    const std::uint8_t* bytes;  ///< the first `room` of them
    std::size_t count, room;
  };

  Outcome take(const dxl::Packet& packet, lockstep::HelloReply& reply, const Brought&) {
    if (!packet.is_status() || packet.size != sizeof reply) return Outcome::kMore;
    __builtin_memcpy(&reply, packet.parameters, sizeof reply);
    return Outcome::kWhole;
  }

  Outcome take(const dxl::Packet& packet, lockstep::Advanced& reply, const Brought& brought) {
    if (!packet.is_status()) return Outcome::kMore;
    if (packet.error == static_cast<std::uint8_t>(dxl::Error::kAccess)) return Outcome::kGone;
    lockstep::Advanced answer;
    if (packet.size != sizeof answer) return Outcome::kMore;
    __builtin_memcpy(&answer, packet.parameters, sizeof answer);
    if (answer.sequence != sequence_) return Outcome::kMore;
    if (answer.size != brought.count || answer.size > brought.room ||
        answer.crc != dxl::crc16(brought.bytes, brought.count)) {
      return Outcome::kSpoilt;
    }
    reply = answer;
    return Outcome::kWhole;
  }

  Link& link_;
  Idle idle_;
  LockstepCounters counters_;
  lockstep::Advanced answer_;
  lockstep::ClockSieve sieve_;
  std::uint8_t sequence_ = 0;
  bool lost_ = true;
  std::size_t used_ = 0;
  std::size_t request_size_ = 0;
  std::uint8_t request_[lockstep::kMaxClockPacket];
  std::uint8_t outbox_[kOutbox + lockstep::kMaxClockPacket];
  std::uint8_t chunk_[256];
};

}  // namespace verp::app
