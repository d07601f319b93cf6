#pragma once
#include <cstdint>

#include "common/protocol/canopen/pdo_record.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::app {

/// Returns nodes that answer the wrong SYNC to the planned one, one at a time, with torque on.
/// Switches their TPDO off and on, so that they wait for its SYNC start value again (CiA 301). The
/// node loses an answer or two; others lose nothing.
class SyncRepair {
 public:
  explicit SyncRepair(const Params& params) : params_(params) {}

  /// The node being repaired; -1: none.
  int slot() const { return slot_; }
  /// Ends the repair of a node that starts anew.
  void cancel(int slot) {
    if (slot == slot_) slot_ = -1;
  }

  /// Call once a tick. Sends the first request, or an unanswered one again.
  template <hal::CanBus Bus>
  void run(CanMaster<Bus>& master, NodeMask astray) {
    if (slot_ < 0 && !choose(astray & ~stubborn_)) return;
    if (asked_ && ++waited_ < kPatience) return;
    if (asked_ && ++missed_ >= kMostMissed) {
      slot_ = -1;
      return;
    }
    send(master);
  }
  /// Takes the node's SDO response. True: the node answers as planned from now on.
  template <hal::CanBus Bus>
  bool receive(CanMaster<Bus>& master, const CanFrame& frame) {
    namespace sdo = canopen::sdo;
    if (!asked_ || frame.size != sdo::kFrameBytes || !(sdo::address_of(frame) == at())) {
      return false;
    }
    if (frame.data[0] == sdo::kAbort) {
      stubborn_ |= node_bit(slot_);
      slot_ = -1;
      return false;
    }
    if (sdo::specifier_of(frame) != sdo::response::kDownload) return false;
    asked_ = false;
    missed_ = 0;
    if (++step_ == steps()) {
      slot_ = -1;
      return true;
    }
    send(master);
    return false;
  }

 private:
  static constexpr std::uint8_t kPatience = 2;     ///< ticks to wait for an answer
  static constexpr std::uint8_t kMostMissed = 50;  ///< answers missed; then the node is silent

  bool choose(NodeMask astray) {
    for (int i = 0; i < kCanNodes && astray != 0; ++i) {
      last_ = last_ + 1 < kCanNodes ? last_ + 1 : 0;
      if ((astray >> last_ & 1) == 0) continue;
      slot_ = last_;
      step_ = missed_ = 0;
      asked_ = false;
      return true;
    }
    return false;
  }
  int steps() const { return slot_ == kImuNode ? 4 : 2; }
  unsigned number() const { return 1u + step_ / 2u; }
  canopen::Address at() const { return {static_cast<std::uint16_t>(0x17FF + number()), 1}; }
  template <hal::CanBus Bus>
  void send(CanMaster<Bus>& master) {
    namespace sdo = canopen::sdo;
    const std::uint8_t node = node_id(params_, slot_);
    const std::uint32_t off = step_ % 2 == 0 ? canopen::kPdoInvalid : 0;
    const std::uint32_t value = canopen::tpdo_id(number(), node) | canopen::kPdoNoRemote | off;
    const std::uint8_t command =
        sdo::command(sdo::request::kDownload, sdo::kExpedited | sdo::kSizeGiven);
    asked_ = true;
    waited_ = 0;
    master.send(sdo::addressed(canopen::sdo_request_id(node), command, at(), value));
  }

  const Params& params_;
  NodeMask stubborn_ = 0;
  int slot_ = -1;
  int last_ = kCanNodes - 1;
  std::uint8_t step_ = 0;
  std::uint8_t waited_ = 0;  ///< ticks
  std::uint8_t missed_ = 0;  ///< answers
  bool asked_ = false;
};

}  // namespace verp::app
