#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::can {

/// Detects another device that acts as a node of the twin's robot. Proof: five heartbeats, TPDOs or
/// SDO answers of one node; random frames hardly ever give five
/// (tests/host/can/other_nodes_test.cpp).
class OtherNodes {
 public:
  explicit OtherNodes(const Params& params) : nodes_(params) {}

  void take(const CanFrame& frame);
  /// First detected node; 0: none.
  std::uint8_t found() const { return found_; }

 private:
  static constexpr std::uint8_t kSigns = 5;

  app::CanNodes nodes_;
  std::uint8_t signs_[app::kCanNodes] = {};
  std::uint8_t found_ = 0;
};

}  // namespace verp::can
