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
  void cancel(int slot);

  /// Call once a tick. Sends the first request, or an unanswered one again.
  void run(CanMaster& master, NodeMask astray);
  /// Takes the node's SDO response. True: the node answers as planned from now on.
  bool receive(CanMaster& master, const CanFrame& frame);

 private:
  static constexpr std::uint8_t kPatience = 2;     ///< ticks to wait for an answer
  static constexpr std::uint8_t kMostMissed = 50;  ///< answers missed; then the node is silent

  bool choose(NodeMask astray);
  int steps() const { return slot_ == kImuNode ? 4 : 2; }
  unsigned number() const { return 1u + step_ / 2u; }
  canopen::Address at() const { return {static_cast<std::uint16_t>(0x17FF + number()), 1}; }
  void send(CanMaster& master);

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
