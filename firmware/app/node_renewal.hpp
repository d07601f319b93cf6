#pragma once
#include <cstdint>

#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/node_settings.hpp"

namespace verp::app {

/// Sets nodes up again while the loop runs, one at a time: one SDO request a tick, several while no
/// torque is on.
class NodeRenewal {
 public:
  explicit NodeRenewal(const Params& params) : params_(params) {}

  /// The node being set up; -1: none.
  int slot() const { return slot_; }
  void receive(const CanFrame& frame, std::uint64_t now_us) { client_.receive(frame, now_us); }
  /// Restarts the set-up of a node that has rebooted, and queues it for stop_one(). It does not
  /// know our SYNC counter and may send EMCY 8240h on each SYNC ahead of other answers. Stopped
  /// (CiA 301) it is silent until its turn.
  void rebooted(int slot) {
    if (slot == slot_) slot_ = -1;
    to_stop_ |= node_bit(slot);
  }
  /// Stops one node that has rebooted; false: there is none.
  template <hal::CanBus Bus>
  bool stop_one(CanMaster<Bus>& master) {
    for (int slot = 0; slot < kCanNodes; ++slot) {
      if ((to_stop_ & node_bit(slot)) == 0) continue;
      to_stop_ &= ~node_bit(slot);
      master.send(canopen::nmt_frame(canopen::NmtCommand::kStop, node_id(params_, slot)));
      return true;
    }
    return false;
  }

  /// Call once a tick; serves `candidates` in turn. Returns the node that was started, or -1.
  template <hal::CanBus Bus>
  int run(CanMaster<Bus>& master, NodeMask candidates) {
    if (slot_ >= 0 && (candidates & node_bit(slot_)) == 0) slot_ = -1;
    if (slot_ < 0) {
      if (!choose(candidates, master.now_us())) return -1;
      // A stopped node would ignore the settings.
      master.send(
          canopen::nmt_frame(canopen::NmtCommand::kEnterPreOperational, node_id(params_, slot_)));
    }
    if (!proceed(master)) return -1;
    if (!finished_) return -1;
    const int done = slot_;
    slot_ = -1;
    master.send(canopen::nmt_frame(canopen::NmtCommand::kStart, node_id(params_, done)));
    return done;
  }
  template <hal::CanBus Bus>
  bool proceed(CanMaster<Bus>& master) {
    if (slot_ < 0 || !advance(master.now_us())) {
      ++master.counters.errors;
      return false;
    }
    CanFrame frame;
    if (!finished_ && client_.next(frame, master.now_us())) master.send(frame);
    return true;
  }

 private:
  bool choose(NodeMask candidates, std::uint64_t now_us) {
    for (int i = 0; i < kCanNodes; ++i) {
      last_ = last_ + 1 < kCanNodes ? last_ + 1 : 0;
      if ((candidates >> last_ & 1) == 0) continue;
      slot_ = last_;
      to_stop_ &= ~node_bit(slot_);
      client_ = canopen::SdoClient(node_id(params_, slot_));
      step_ = 0;
      begin(now_us);
      return true;
    }
    return false;
  }
  void begin(std::uint64_t now_us) {
    finished_ = !node_setting(params_, slot_, step_, setting_);
    if (finished_) return;
    canopen::put_le(data_, setting_.value, 4);
    client_.download(setting_.at, data_, setting_.bytes, canopen::SdoClient::Mode::kPlain, now_us);
  }
  // Moves on when a setting is written; false if the node refused it or was silent.
  bool advance(std::uint64_t now_us) {
    using State = canopen::SdoClient::State;
    if (client_.state() == State::kBusy || finished_) return true;
    if (client_.state() == State::kAborted) {
      const canopen::Abort why = client_.reason();
      const bool absent = why == canopen::Abort::kNoObject || why == canopen::Abort::kNoSubindex;
      if (!setting_.optional || !absent) {
        slot_ = -1;
        return false;
      }
    }
    ++step_;
    begin(now_us);
    return true;
  }

  const Params& params_;
  canopen::SdoClient client_{1};
  Setting setting_;
  std::uint8_t data_[4] = {};
  NodeMask to_stop_ = 0;
  int slot_ = -1;
  int last_ = kCanNodes - 1;
  int step_ = 0;
  bool finished_ = false;
};

}  // namespace verp::app
