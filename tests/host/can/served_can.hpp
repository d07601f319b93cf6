#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <random>
#include <utility>
#include <vector>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "hal/contract/can_bus.hpp"
#include "host/twin/can/lockstep_server.hpp"

/// A controller's bus to a server in the same thread. A seeded generator loses, doubles or swaps
/// frames.
namespace verp::can {

struct Odds {
  double lost = 0, doubled = 0, swapped = 0;  ///< of frames
  double foreign = 0;                         ///< share of frames after another sender's
};

class ServedCan final : public hal::CanBus {
 public:
  explicit ServedCan(LockstepServer& server) : server_(server) {}

  bool send(const CanFrame& frame) override {
    if (cut) return true;
    if (lost_beginnings > 0 && VirtualCan::begins_tick(frame)) {
      --lost_beginnings;
      ++faults;
      return true;
    }
    spoil(frame, outbound, to_server_);
    return true;
  }
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override {
    if (to_client_.empty()) serve();
    if (to_client_.empty()) {
      now_us_ += timeout_us;
      return false;
    }
    frame = to_client_.front();
    to_client_.pop_front();
    return true;
  }
  std::uint64_t now_us() override { return now_us_; }
  hal::CanErrors errors() const override { return {}; }

  Odds outbound, inbound;
  bool cut = false;
  unsigned lost_beginnings = 0;  ///< SYNCs 1 that the server misses
  unsigned faults = 0, strangers = 0;
  unsigned requests = 0;  ///< for the controller's node, with each answer
  unsigned requests_heard = 0;
  std::size_t most_room = 0;  ///< of an answer, in a receive FIFO

 private:
  void serve() {
    std::vector<CanFrame> answer;
    for (const CanFrame& each : to_server_) server_.take(each, answer);
    to_server_.clear();
    std::size_t room = 0;
    for (const CanFrame& each : answer) {
      room += lockstep::room_of(each);
      if (!each.extended && each.id == request().id) {
        ++requests_heard;
        continue;
      }
      spoil(each, inbound, to_client_);
    }
    if (requests > 0) --requests, server_.enclose(request());
    most_room = std::max(most_room, room);
  }
  static CanFrame request() {
    return canopen::classic_frame(canopen::sdo_request_id(canopen::plan::kControllerNode), 8);
  }
  // CAN keeps an identifier's order; the clock's frames come last.
  void spoil(const CanFrame& frame, const Odds& odds, std::deque<CanFrame>& to) {
    std::uniform_real_distribution<double> chance(0, 1);
    if (odds.foreign > 0 && chance(random_) < odds.foreign) to.push_back(stranger());
    const double dice = chance(random_);
    const bool lost = dice < odds.lost;
    const bool doubled = !lost && dice < odds.lost + odds.doubled;
    if (!lost) to.push_back(frame);
    if (doubled) to.push_back(frame);
    faults += lost || doubled ? 1 : 0;
    const std::size_t size = to.size();
    if (chance(random_) >= odds.swapped || size < 2 || frame.extended) return;
    if (to[size - 2].extended || to[size - 2].id == frame.id) return;
    std::swap(to[size - 1], to[size - 2]);
    ++faults;
  }

  /// 29 bits, remote, an unused identifier, or a node's.
  CanFrame stranger() {
    CanFrame frame;
    frame.size = 8;
    frame.data[0] = static_cast<std::uint8_t>(random_());
    switch (random_() % 4) {
      case 0:
        frame.id = random_() % 0x1000000u;
        frame.extended = true;
        break;
      case 1:
        frame.id = 0x601;
        frame.remote = true;
        break;
      case 2:
        frame.id = 0x7E5;
        break;
      default:
        frame.id = 0x181;
    }
    ++strangers;
    return frame;
  }

  LockstepServer& server_;
  std::deque<CanFrame> to_server_, to_client_;
  std::minstd_rand random_{7};
  std::uint64_t now_us_ = 0;
};

}  // namespace verp::can
