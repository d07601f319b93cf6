#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/app.hpp"

namespace verp::bus {

/// The controller at the end of a link, once more, here: the same control loop, given the bytes,
/// times and orders that the other one got, a tick behind it. It brings back what no link carries
/// (Inputs, State, Outputs of each tick) and tells whether the other one sent the same frames.
class ShadowLoop {
 public:
  using Record = std::function<void(const TickRecord&, const State&, const Outputs&)>;

  ShadowLoop(const Params& params, Record record);
  ~ShadowLoop();

  // What the other controller does, in its order.
  void sent(std::span<const std::uint8_t> frame);
  /// Frames were lost on the link: what was sent up to the next poll can't be compared.
  void damaged();
  void polled(std::span<const std::uint8_t> bytes, std::uint64_t now_us);
  /// Holds from the next poll on; its flags for one tick.
  void ordered(const app::OperatorOrder& order);

  /// Goes through all ticks (at first: the bring-up) of which every poll is known.
  void catch_up();

  /// The first frame that the other controller sent and this one did not, in words; empty while
  /// there is none.
  const std::string& difference() const { return tape_.difference; }

 private:
  struct Poll {
    std::vector<std::vector<std::uint8_t>> frames;  ///< sent since the poll before
    bool comparable = true;
    std::optional<app::OperatorOrder> order;
    std::vector<std::uint8_t> bytes;
    std::uint64_t now_us = 0;
  };

  /// What was recorded, as FrameBus, OperatorLink and Recorder of the loop here.
  struct Tape {
    bool send(const std::uint8_t* data, std::size_t size);
    std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us);
    std::uint64_t now_us() const { return here.time_us; }
    app::OperatorOrder order(std::uint32_t tick);
    void record(const TickRecord& record, const State& state, const Outputs& outputs);
    void compare(const Poll& poll);

    std::deque<Poll> polls;
    Record recorder;
    std::string difference;
    struct Mark {
      std::size_t played = 0;                         ///< of polls
      std::vector<std::vector<std::uint8_t>> frames;  ///< of the loop here, since the poll before
      app::OperatorOrder standing;
      std::uint64_t time_us = 0;
    } here;
    std::uint32_t tick = 0;
    bool ticking = false;
    bool torn = false;  ///< the loop asked for a poll that has not been yet
  };
  using Loop = app::App<Tape, Tape, Tape>;

  /// One tick or bring-up; false, and nothing happened, if the tape ends within it.
  bool play();

  Tape tape_;
  Poll next_;
  std::unique_ptr<Loop> loop_;
};

}  // namespace verp::bus
