#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "firmware/app/action_room.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/link_messages.hpp"
#include "hal/contract/frame_bus.hpp"

namespace verp::app {

/// read_some() waits for at least one byte; 0 once the far end closed. write() waits until all
/// bytes have gone; false once the far end closed.
template <class Stream>
concept InStream = requires(Stream& stream, void* to, std::size_t capacity) {
  { stream.read_some(to, capacity) } -> std::same_as<std::size_t>;
};
template <class Stream>
concept OutStream = requires(Stream& stream, const void* from, std::size_t size) {
  { stream.write(from, size) } -> std::same_as<bool>;
};

/// The controller's end of link_messages.hpp: FrameBus, OperatorLink and Recorder over two byte
/// streams. Call hello() first. After a loss, polls return nothing and stopped() is true.
template <InStream In, OutStream Out>
class RemoteBus final : public hal::FrameBus {
 public:
  RemoteBus(In& in, Out& out) : in_(in), out_(out) {}

  /// Fetches Params, actions and the run's settings. False: refused, link lost, or no room for the
  /// actions.
  bool hello(Params& params, ActionRoom* actions = nullptr) {
    append(link::Kind::kHello, link::Hello{.params_size = sizeof(Params),
                                           .record_size = sizeof(TickRecord),
                                           .state_size = sizeof(State)});
    return flush() && read(&run_, sizeof run_) && run_.status == link::HelloStatus::kReady &&
           run_.params_size == sizeof(Params) && read(&params, sizeof params) &&
           (run_.actions_size == 0 || (actions != nullptr && read_actions(*actions)));
  }

  action::Library actions(const ActionRoom& room) const { return room.library(run_.actions_size); }
  /// Ticks of the run; 0: until stopped().
  std::uint32_t ticks() const { return run_.ticks; }
  /// The PC wants no further tick, or is gone.
  bool stopped() const { return lost_ || (reply_.flags & link::kStop) != 0; }
  bool lost() const { return lost_; }
  std::uint32_t refused() const { return refused_; }

  // FrameBus
  bool send(const std::uint8_t* data, std::size_t size) override {
    if (lost_ || size == 0 || size > hal::kMaxFrame) return false;
    append_bytes(link::Kind::kSend, data, size);
    return true;
  }
  std::size_t poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) override {
    if (capacity > link::kMaxPollBytes) capacity = link::kMaxPollBytes;
    append(link::Kind::kPoll,
           link::Poll{.timeout_us = timeout_us, .capacity = static_cast<std::uint16_t>(capacity)});
    if (!flush() || !read_reply(capacity)) return 0;
    __builtin_memcpy(buffer, inbox_ + sizeof reply_, reply_.size);
    return reply_.size;
  }
  std::uint64_t now_us() override { return reply_.now_us; }

  // OperatorLink
  OperatorOrder order(std::uint32_t) const { return reply_.order; }

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    const bool new_fault = outputs.faults != faults_;
    faults_ = outputs.faults;
    if (new_fault || (run_.state_every != 0 && record.inputs.tick % run_.state_every == 0)) {
      append(link::Kind::kState, state);
    }
    append(link::Kind::kOutputs, outputs);
    append(link::Kind::kRecord, record);
  }

  /// `text`: the reason in one line.
  void quit(std::uint32_t exit_code, const char* text) {
    std::size_t length = 0;
    while (text[length] != 0 && length < kMaxText) ++length;
    const link::Quit quit{.exit_code = exit_code};
    std::uint8_t payload[sizeof quit + kMaxText];
    __builtin_memcpy(payload, &quit, sizeof quit);
    __builtin_memcpy(payload + sizeof quit, text, length);
    append_bytes(link::Kind::kQuit, payload, sizeof quit + length);
    flush();
  }

 private:
  static constexpr std::size_t kMaxText = 120;
  /// Room for State, Outputs, record, three Sync Writes, a read, a poll.
  static constexpr std::size_t kOutbox = sizeof(TickRecord) + sizeof(State) + sizeof(Outputs) +
                                         4 * hal::kMaxFrame + 16 * sizeof(link::MessageHeader);

  template <class Payload>
  void append(link::Kind kind, const Payload& payload) {
    static_assert(packed_size<Payload>() == sizeof(Payload));
    append_bytes(kind, &payload, sizeof payload);
  }

  void append_bytes(link::Kind kind, const void* payload, std::size_t size) {
    const link::MessageHeader header{.kind = kind, .size = static_cast<std::uint16_t>(size)};
    if (used_ + sizeof header + size > kOutbox) flush();
    __builtin_memcpy(outbox_ + used_, &header, sizeof header);
    __builtin_memcpy(outbox_ + used_ + sizeof header, payload, size);
    used_ += sizeof header + size;
  }

  bool read_actions(ActionRoom& room) {
    return run_.actions_size <= ActionRoom::kBytes && read(room.bytes, run_.actions_size);
  }

  bool flush() {
    lost_ = lost_ || !out_.write(outbox_, used_);
    used_ = 0;
    return !lost_;
  }

  bool read(void* data, std::size_t size) {
    auto* bytes = static_cast<std::uint8_t*>(data);
    while (size > 0 && !lost_) {
      const std::size_t count = in_.read_some(bytes, size);
      lost_ = count == 0;
      bytes += count;
      size -= count;
    }
    return !lost_;
  }

  bool read_reply(std::size_t capacity) {
    std::size_t have = 0;
    std::size_t want = sizeof reply_;
    while (have < want && !lost_) {
      const std::size_t count = in_.read_some(inbox_ + have, sizeof inbox_ - have);
      lost_ = count == 0;
      have += count;
      if (have < sizeof reply_) continue;
      __builtin_memcpy(&reply_, inbox_, sizeof reply_);
      want = sizeof reply_ + reply_.size;
      lost_ = lost_ || reply_.size > capacity;
    }
    if (lost_) return false;
    if ((reply_.flags & link::kSendFailed) != 0) ++refused_;
    return true;
  }

  In& in_;
  Out& out_;
  link::HelloReply run_;
  link::PollReply reply_;
  std::uint32_t faults_ = 0;
  std::uint32_t refused_ = 0;
  bool lost_ = false;
  std::size_t used_ = 0;
  std::uint8_t outbox_[kOutbox];
  std::uint8_t inbox_[link::kMaxReply];
};

}  // namespace verp::app
