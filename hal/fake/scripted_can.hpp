#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/contract/can_bus.hpp"

/// A CanBus that plays a script of expected frames and timed answers. Also runs on a
/// microcontroller. Frames take no time: an accepted frame has left, unless the bus is held.
namespace verp::hal {

class ScriptedCan final : public CanBus {
 public:
  static constexpr std::size_t kFrames = 112;  ///< frames that have not arrived yet
  static constexpr std::size_t kScript = 16;   ///< expected frames
  static constexpr std::size_t kAnswers = 16;
  static constexpr std::size_t kHeard = 64;         ///< sent frames that wait for take_sent()
  static constexpr std::uint32_t kBusOffUs = 1408;  ///< 128 times 11 bits at 1 Mbit/s

  /// Expects `frame` next. False: script full.
  bool expect(const CanFrame& frame) {
    if (expected_ == kScript) return false;
    script_[expected_++] = {frame, 0, expected_};
    return true;
  }
  /// `frame` arrives `delay_us` after the most recently expected frame was sent.
  bool answer(const CanFrame& frame, std::uint32_t delay_us) {
    if (answers_ == kAnswers) return false;
    answer_[answers_++] = {frame, delay_us, expected_};
    return true;
  }
  /// `frame` arrives at `time_us` in any case.
  bool inject(const CanFrame& frame, std::uint64_t time_us) {
    if (arrivals_ == kFrames) return false;
    std::size_t at = arrivals_++;
    for (; at > 0 && arrival_[at - 1].time_us > time_us; --at) arrival_[at] = arrival_[at - 1];
    arrival_[at] = {frame, time_us, 0};
    return true;
  }
  /// True if the whole script was played and no other frame was sent.
  bool finished() const { return mismatches_ == 0 && played_ == expected_; }
  std::size_t mismatches() const { return mismatches_; }

  bool take_sent(CanFrame& frame) {
    if (left_ == 0) return false;
    frame = sent_[0];
    forget(1);
    --left_;
    return true;
  }
  /// While held, accepted frames wait, as if another node had the bus.
  void hold(bool yes) {
    held_ = yes;
    if (!yes) let_go();
  }
  /// Drops waiting frames and refuses new ones for kBusOffUs.
  void bus_off() {
    ++errors_.bus_offs;
    errors_.dropped += static_cast<std::uint32_t>(queued_ - left_);
    queued_ = left_;
    off_until_us_ = now_us_ + kBusOffUs;
  }
  void count_error() { ++errors_.errors; }

  bool send(const CanFrame& frame) override {
    if (!is_sound(frame) || now_us_ < off_until_us_) return false;
    if (queued_ - left_ == kCanQueue || queued_ == kHeard) return false;
    sent_[queued_++] = frame;
    sent_us_ = now_us_;
    if (!held_) let_go();
    return true;
  }

  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    std::uint64_t deadline_us = sent_us_ + timeout_us;
    if (deadline_us < now_us_) deadline_us = now_us_;
    if (arrivals_ == 0 || arrival_[0].time_us > deadline_us) {
      now_us_ = deadline_us;
      return false;
    }
    frame = arrival_[0].frame;
    if (now_us_ < arrival_[0].time_us) now_us_ = arrival_[0].time_us;
    --arrivals_;
    for (std::size_t i = 0; i < arrivals_; ++i) arrival_[i] = arrival_[i + 1];
    return true;
  }

  std::uint64_t now_us() override { return now_us_; }
  CanErrors errors() const override { return errors_; }

 private:
  struct Line {
    CanFrame frame;
    std::uint64_t time_us;
    std::size_t after;  ///< for an answer: expected frames before it
  };

  void let_go() {
    for (; left_ < queued_; ++left_) play(sent_[left_]);
  }
  void play(const CanFrame& frame) {
    if (played_ == expected_ || !(script_[played_].frame == frame)) {
      ++mismatches_;
      return;
    }
    ++played_;
    for (std::size_t i = 0; i < answers_; ++i) {
      const Line& each = answer_[i];
      if (each.after == played_ && !inject(each.frame, now_us_ + each.time_us)) ++mismatches_;
    }
  }
  void forget(std::size_t frames) {
    queued_ -= frames;
    for (std::size_t i = 0; i < queued_; ++i) sent_[i] = sent_[i + frames];
  }

  Line script_[kScript] = {};
  Line answer_[kAnswers] = {};
  Line arrival_[kFrames] = {};
  CanFrame sent_[kHeard] = {};  ///< the sent frames, then the waiting ones
  std::size_t expected_ = 0;
  std::size_t answers_ = 0;
  std::size_t arrivals_ = 0;
  std::size_t played_ = 0;
  std::size_t mismatches_ = 0;
  std::size_t left_ = 0;
  std::size_t queued_ = 0;
  bool held_ = false;
  CanErrors errors_;
  std::uint64_t now_us_ = 0;
  std::uint64_t sent_us_ = 0;
  std::uint64_t off_until_us_ = 0;
};

}  // namespace verp::hal
