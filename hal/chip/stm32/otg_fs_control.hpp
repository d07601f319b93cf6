#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/stm32/otg_fs_core.hpp"

namespace verp::hal::stm32 {

/// Moves each request, its data and its status, and applies `Function`'s decisions to the other
/// endpoints. Called by the interrupt.
template <Io Access, class Function>
class OtgFsControl {
  using Core = OtgFsCore<Access>;

 public:
  OtgFsControl(Core& core, Function& function) : core_(core), function_(function) {}

  /// After a bus reset.
  void start_over() { stage_ = Stage::kIdle; }

  void fetch_setup(std::uint32_t size) { fetch(setup_, sizeof setup_, size); }
  void fetch_data(std::uint32_t size) { data_size_ = fetch(data_, sizeof data_, size); }

  /// True if a packet has left.
  bool serve_in() {
    if (core_.take_in(0) == 0) return false;
    if (stage_ == Stage::kSending) {
      send_answer();
    } else {
      end();
    }
    return true;
  }
  /// True if a request or a packet has arrived.
  bool serve_out() {
    const std::uint32_t flags = core_.take_out(0);
    if ((flags & otg_fs::kDoepXfrc) != 0) serve_data();
    if ((flags & otg_fs::kDoepStup) != 0) serve_setup();
    return flags != 0;
  }

 private:
  static constexpr std::uint32_t kPacket = Core::kPacket;
  enum class Stage : std::uint8_t { kIdle, kSending, kReceiving, kStatusIn, kStatusOut };

  std::size_t fetch(std::uint8_t* buffer, std::size_t capacity, std::uint32_t size) {
    std::size_t count = 0;
    core_.take(size, [&](std::uint8_t byte) {
      if (count < capacity) buffer[count++] = byte;
    });
    return count;
  }

  void serve_setup() {
    core_.cancel_send(0);  // a new request ends one that the host gave up
    const auto answer = function_.setup(setup_);
    using Wanted = decltype(answer.stage);
    act(answer.action, answer.value);
    data_size_ = 0;
    switch (answer.stage) {
      case Wanted::kSend:
        answer_ = answer.data;
        left_ = answer.size;
        ended_ = !(answer.shorter && answer.size % kPacket == 0);
        stage_ = Stage::kSending;
        return send_answer();
      case Wanted::kReceive:
        stage_ = Stage::kReceiving;
        return core_.expect(0);
      case Wanted::kDone:
        return send_status();
      default:
        return refuse();
    }
  }
  void send_answer() {
    if (left_ == 0 && ended_) {
      stage_ = Stage::kStatusOut;
      return core_.expect(0);
    }
    const std::uint32_t size = left_ < kPacket ? left_ : kPacket;
    const std::uint8_t* data = answer_;
    if (!core_.send(0, size, [data](std::uint32_t i) { return data[i]; })) return refuse();
    if (left_ == 0) ended_ = true;
    answer_ += size;
    left_ -= size;
  }
  void send_status() {
    stage_ = Stage::kStatusIn;
    core_.send(0, 0, [](std::uint32_t) { return std::uint8_t{0}; });
  }
  void serve_data() {
    if (stage_ == Stage::kStatusOut) return end();
    if (stage_ != Stage::kReceiving) return;
    if (!function_.received(data_, data_size_)) return refuse();
    send_status();
  }
  void refuse() {
    core_.stall(0x80);
    core_.stall(0x00);
    end();
  }
  void end() {
    stage_ = Stage::kIdle;
    core_.expect_setup();
  }

  template <class Action>
  void act(Action action, std::uint8_t value) {
    switch (action) {
      case Action::kAddress:
        return core_.set_address(value);
      case Action::kConfigure:
        return configure(value != 0);
      case Action::kHalt:
        return core_.stall(value);
      case Action::kRelease:
        return core_.unstall(value);
      default:
        return;
    }
  }
  void configure(bool on) {
    for (const auto& each : Function::kEndpoints) {
      if (on) {
        core_.open_endpoint(each.address, each.type, each.packet);
      } else {
        core_.close_endpoint(each.address);
      }
    }
  }

  Core& core_;
  Function& function_;
  std::uint8_t setup_[8] = {};
  std::uint8_t data_[kPacket] = {};
  std::size_t data_size_ = 0;
  const std::uint8_t* answer_ = nullptr;
  std::uint32_t left_ = 0;  ///< bytes of answer_ to send
  bool ended_ = true;       ///< no empty packet must follow
  Stage stage_ = Stage::kIdle;
};

}  // namespace verp::hal::stm32
