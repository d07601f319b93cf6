#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/model/params.hpp"
#include "firmware/app/lockstep_bus.hpp"
#include "firmware/app/lockstep_can_messages.hpp"
#include "hal/contract/can_bus.hpp"

namespace verp::app {

/// The controller's end of lockstep_can_messages.hpp; waits like LockstepBus. The time of `Bus`
/// only decides when to ask again.
template <std::derived_from<hal::CanBus> Bus, IdleHook Idle>
class LockstepCan final : public hal::CanBus {
 public:
  /// `slice_us`: longest wait between two calls of `idle`.
  LockstepCan(Bus& bus, Idle idle, std::uint32_t slice_us = kSlice_us)
      : bus_(bus), idle_(idle), slice_us_(slice_us) {}

  /// greet(), stopped() and lost(): as LockstepBus's.
  lockstep::Verdict greet(const Params& params) {
    const lockstep::Hello hello = hello_of(params);
    forget();
    lockstep::HelloReply reply;
    const bool answered = ask(
        [&] { return announce(hello); },
        [&](const CanFrame& frame) {
          return lockstep::take_message(frame, lockstep::kCanHelloReplyId, reply) ? Outcome::kWhole
                                                                                  : Outcome::kMore;
        });
    if (!answered) return lockstep::Verdict::kNoAnswer;
    lost_ = reply.verdict != lockstep::Verdict::kAccepted;
    return reply.verdict;
  }

  bool stopped() const { return lost_ || over_; }
  bool lost() const { return lost_; }
  const LockstepCounters& counters() const { return counters_; }

  // CanBus.
  bool send(const CanFrame& frame) override {
    if (lost_ || over_ || lockstep::is_clock_frame(frame) || !push(frame)) return false;
    ++sent_;
    sent_sum_ = static_cast<std::uint16_t>(sent_sum_ + lockstep::sum_of(frame));
    return true;
  }

  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    if (lost_) return false;
    if (taken_ == count_ && !advance(timeout_us)) return false;
    if (taken_ == count_) return false;
    frame = burst_[taken_++];
    return true;
  }

  std::uint64_t now_us() override { return now_us_; }
  hal::CanErrors errors() const override { return bus_.errors(); }

 private:
  enum class Outcome : std::uint8_t { kMore, kWhole, kSpoilt, kGone };
  static constexpr std::uint32_t kSlice_us = 1000;
  static constexpr std::uint32_t kFirstPatience_us = 500'000;  ///< a loaded PC is slow
  static constexpr std::uint32_t kLastPatience_us = 2'000'000;

  void forget() {
    lost_ = true;
    over_ = false;
    now_us_ = 0;
    count_ = taken_ = 0;
    sent_ = 0;
    sent_sum_ = 0;
  }

  bool announce(const lockstep::Hello& hello) {
    std::uint8_t part[kMaxCanData];
    for (std::uint32_t i = 0; i < lockstep::kCanHelloParts; ++i) {
      __builtin_memcpy(part, reinterpret_cast<const std::uint8_t*>(&hello) + i * sizeof part,
                       sizeof part);
      if (!push(lockstep::can_message(lockstep::kCanHelloId + i, part))) return false;
    }
    return true;
  }

  // Queues a frame; waits for room as long as `idle` allows.
  bool push(const CanFrame& frame) {
    CanFrame stray;
    while (!bus_.send(frame)) {
      if (!idle_()) return false;
      hear(stray);
    }
    pushed_us_ = bus_.now_us();
    return true;
  }

  bool hear(CanFrame& frame) {
    return bus_.poll(frame, static_cast<std::uint32_t>(bus_.now_us() - pushed_us_) + slice_us_);
  }

  // Gets one new answer of the twin into burst_ and now_us_.
  bool advance(std::uint32_t timeout_us) {
    const lockstep::CanAdvance request{
        .sequence = ++sequence_, .sent = sent_, .sent_sum = sent_sum_, .timeout_us = timeout_us};
    sent_ = 0;
    sent_sum_ = 0;
    count_ = taken_ = 0;
    lost_ = !ask([&] { return push(lockstep::can_message(lockstep::kCanAdvanceId, request)); },
                 [&](const CanFrame& frame) { return collect(frame); });
    return !lost_;
  }

  Outcome collect(const CanFrame& frame) {
    lockstep::CanAdvanced answer;
    if (!lockstep::is_clock_frame(frame)) {
      if (count_ < lockstep::kMaxBurst) burst_[count_] = frame;
      ++count_;
      return Outcome::kMore;
    }
    if (!lockstep::take_message(frame, lockstep::kCanAdvancedId, answer)) return Outcome::kMore;
    if (answer.sequence != sequence_) {
      count_ = 0;  // they belonged to another answer
      return Outcome::kMore;
    }
    const std::uint8_t flags = answer.flags_count & ((1u << lockstep::kCanCountShift) - 1);
    if ((flags & lockstep::kNotGreeted) != 0) return Outcome::kGone;
    if (count_ != std::size_t{answer.flags_count} >> lockstep::kCanCountShift ||
        sum_of_burst() != answer.burst_sum) {
      count_ = 0;
      return Outcome::kSpoilt;
    }
    over_ = (flags & lockstep::kStop) != 0;
    if ((flags & lockstep::kFrameDamaged) != 0) ++counters_.damaged;
    now_us_ += answer.now_low_us - static_cast<std::uint32_t>(now_us_);
    return Outcome::kWhole;
  }

  std::uint16_t sum_of_burst() const {
    std::uint16_t sum = 0;
    for (std::size_t i = 0; i < count_ && i < lockstep::kMaxBurst; ++i) {
      sum = static_cast<std::uint16_t>(sum + lockstep::sum_of(burst_[i]));
    }
    return sum;
  }

  /// Passes frames to `take` until it has the answer; repeats `request` as needed. False: given up.
  template <class Request, class Handler>
  bool ask(Request&& request, Handler&& take) {
    std::uint32_t patience_us = kFirstPatience_us;
    for (;;) {
      if (!request()) return false;
      const Outcome outcome = wait(patience_us, take);
      if (outcome == Outcome::kWhole) return true;
      if (outcome == Outcome::kGone || !idle_()) return false;
      ++counters_.repeats;
      if (outcome == Outcome::kSpoilt) {
        ++counters_.spoilt;
      } else {
        if (over_) return false;
        patience_us = patience_us < kLastPatience_us / 2 ? 2 * patience_us : kLastPatience_us;
      }
    }
  }

  /// kMore: no answer came.
  template <class Handler>
  Outcome wait(std::uint32_t patience_us, Handler& take) {
    const std::uint64_t since_us = bus_.now_us();
    CanFrame frame;
    while (bus_.now_us() - since_us < patience_us) {
      if (!hear(frame)) {
        if (!idle_()) return Outcome::kGone;
        continue;
      }
      const Outcome outcome = take(frame);
      if (outcome != Outcome::kMore) return outcome;
    }
    return Outcome::kMore;
  }

  Bus& bus_;
  Idle idle_;
  const std::uint32_t slice_us_;
  LockstepCounters counters_;
  std::uint64_t now_us_ = 0;
  std::uint64_t pushed_us_ = 0;  ///< when bus_ took its last frame
  std::size_t count_ = 0;        ///< frames in the answer; kMaxBurst are kept
  std::size_t taken_ = 0;
  std::uint16_t sent_sum_ = 0;
  std::uint8_t sent_ = 0;
  std::uint8_t sequence_ = 0;
  bool lost_ = true;
  bool over_ = false;
  CanFrame burst_[lockstep::kMaxBurst];
};

}  // namespace verp::app
