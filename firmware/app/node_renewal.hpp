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
  void rebooted(int slot);
  /// Stops one node that has rebooted; false: there is none.
  bool stop_one(CanMaster& master);

  /// Call once a tick; serves `candidates` in turn. Returns the node that was started, or -1.
  int run(CanMaster& master, NodeMask candidates);
  bool proceed(CanMaster& master);

 private:
  bool choose(NodeMask candidates, std::uint64_t now_us);
  void begin(std::uint64_t now_us);
  // Moves on when a setting is written; false if the node refused it or was silent.
  bool advance(std::uint64_t now_us);

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
