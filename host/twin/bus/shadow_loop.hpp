#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/app.hpp"

namespace verp::bus {

/// Recording of a remote controller, poll by poll. It is the OperatorLink and Recorder of a local
/// loop that repeats the run; the kind of bus adds:
///  - Sent: a frame that the controller sent. Received: all that one answer brought.
///  - kWholeTicks: catch_up() is called at the start of each tick.
template <class Bus, class Sent_, class Received_>
class ShadowTape : public Bus {
 public:
  using Sent = Sent_;
  using Received = Received_;
  struct Poll {
    std::vector<Sent> frames;
    bool comparable = true;
    std::optional<app::OperatorOrder> order;
    Received received;
    std::uint64_t now_us = 0;
  };
  struct Mark {
    std::size_t played = 0;
    std::vector<Sent> frames;
    Received received;      ///< by the last poll played
    std::size_t taken = 0;  ///< of `received`, already read
    app::OperatorOrder standing;
    std::uint64_t time_us = 0;
  };

  std::uint64_t now_us() override { return here.time_us; }
  app::OperatorOrder order(std::uint32_t) {
    const app::OperatorOrder order = here.standing;
    here.standing.flags = 0;
    return order;
  }
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    if (torn) return;
    tick = record.inputs.tick;
    if (recorder) recorder(record, state, outputs);
  }

  std::deque<Poll> polls;
  std::function<void(const TickRecord&, const State&, const Outputs&)> recorder;
  std::string difference;
  Mark here;
  std::uint32_t tick = 0;
  bool ticking = false;
  bool torn = false;  ///< the loop asked for a poll not recorded yet

 protected:
  ~ShadowTape() = default;
  /// Plays the next poll; false at the end of the tape.
  template <class Same>
  bool play(Same same) {
    torn = torn || here.played == polls.size();
    if (torn) return false;
    const Poll& poll = polls[here.played++];
    if (difference.empty() && poll.comparable && !same(here.frames, poll.frames)) {
      difference = (ticking ? "in tick " + std::to_string(tick) : std::string("in the bring-up")) +
                   " the controller's " + std::to_string(poll.frames.size()) +
                   " frames before a poll are not those that this PC sends";
    }
    here.frames.clear();
    here.received = poll.received;
    here.taken = 0;
    here.time_us = poll.now_us;
    if (poll.order) here.standing = *poll.order;
    return true;
  }
};

class Shadow {
 public:
  using Record = std::function<void(const TickRecord&, const State&, const Outputs&)>;

  virtual ~Shadow() = default;
  /// Frames were lost: those up to the next poll cannot be compared.
  virtual void damaged() = 0;
  /// The order holds from the next poll on; flags hold for one tick.
  virtual void ordered(const app::OperatorOrder& order) = 0;
  virtual void catch_up() = 0;
  /// Empty: the frames are equal.
  virtual const std::string& difference() const = 0;
};

/// Repeats the remote controller's loop locally, one tick behind. It recovers Inputs, State and
/// Outputs, which no link carries, and compares the sent frames.
template <class Tape>
class ShadowLoopOver final : public Shadow {
 public:
  /// Library of the remote controller.
  ShadowLoopOver(const Params& params, Record record, const action::Library& actions = {})
      : loop_(std::make_unique<Loop>(params, tape_, tape_, tape_, nullptr, app::Core{actions})) {
    tape_.recorder = std::move(record);
  }
  ShadowLoopOver(const ShadowLoopOver&) = delete;
  ShadowLoopOver& operator=(const ShadowLoopOver&) = delete;

  void sent(typename Tape::Sent frame) { next_.frames.push_back(std::move(frame)); }
  void damaged() override { next_.comparable = false; }
  void polled(typename Tape::Received received, std::uint64_t now_us) {
    next_.received = std::move(received);
    next_.now_us = now_us;
    tape_.polls.push_back(std::exchange(next_, {}));
  }
  void ordered(const app::OperatorOrder& order) override { next_.order = order; }

  /// Runs all ticks (first: the bring-up) whose polls are recorded. With kWholeTicks: the bring-up
  /// when the first tick begins, then one tick per call, and more if a tick's beginning was lost.
  void catch_up() override {
    if constexpr (Tape::kWholeTicks) {
      const bool began = tape_.ticking;
      const bool whole = std::all_of(tape_.polls.begin(), tape_.polls.end(),
                                     [](const auto& poll) { return poll.comparable; });
      do run();
      while (!tape_.ticking && !tape_.torn);
      if (tape_.torn) miss_polls(began);
      forget_played();
      if (tape_.torn) return;
      // Another tick's start may be lost.
      while (!whole && !tape_.polls.empty() && try_to_run()) forget_played();
    } else {
      while (!tape_.polls.empty() && try_to_run()) forget_played();
    }
  }

  const std::string& difference() const override { return tape_.difference; }

 private:
  using Loop = app::App<Tape, Tape, Tape>;

  void forget_played() {
    tape_.polls.erase(tape_.polls.begin(),
                      tape_.polls.begin() + static_cast<std::ptrdiff_t>(tape_.here.played));
    tape_.here.played = 0;
  }
  void miss_polls(bool ticking) {
    if (!tape_.difference.empty()) return;
    tape_.difference = (ticking ? "in the tick after " + std::to_string(tape_.tick)
                                : std::string("in the bring-up")) +
                       " the controller did not ask for all that this PC asks for";
  }
  void run() {
    tape_.torn = false;
    if (tape_.ticking) return loop_->tick();
    const bool ready = loop_->bring_up().status == app::BringUpStatus::kReady;
    tape_.ticking = ready && !tape_.torn;
  }
  /// Like run(); false and no change at the end of the tape. Polls do not show a tick's end, and
  /// after an error the next tick begins with a poll that clears the line: so the loop retries when
  /// more polls are known.
  bool try_to_run() {
    const Loop before(*loop_);
    const typename Tape::Mark mark = tape_.here;
    run();
    if (!tape_.torn) return true;
    loop_ = std::make_unique<Loop>(before);
    tape_.here = mark;
    return false;
  }

  Tape tape_;
  typename Tape::Poll next_;
  std::unique_ptr<Loop> loop_;
};

class SerialTape final
    : public ShadowTape<hal::FrameBus, std::vector<std::uint8_t>, std::vector<std::uint8_t>> {
 public:
  static constexpr bool kWholeTicks = false;
  bool send(const std::uint8_t* data, std::size_t size) override {
    here.frames.emplace_back(data, data + size);
    return true;
  }
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t) override {
    if (!play([](const auto& a, const auto& b) { return a == b; })) return 0;
    const std::size_t count = std::min(capacity, here.received.size());
    std::copy_n(here.received.begin(), count, buffer);
    return count;
  }
};
using ShadowLoop = ShadowLoopOver<SerialTape>;

}  // namespace verp::bus
