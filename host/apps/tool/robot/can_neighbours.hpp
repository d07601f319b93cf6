#pragma once
#include <cstdint>
#include <string>

#include "common/base/can_frame.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::tool {

/// Names another program or device that talks on the robot's CAN bus as the controller does, or
/// with the node id of one of its drives.
class CanNeighbours {
 public:
  explicit CanNeighbours(const Params& params) : params_(params), nodes_(params) {}

  void sent(const CanFrame& frame);
  void came(const CanFrame& frame);
  /// One line for each neighbour, once; else empty.
  std::string news();

 private:
  struct Drive {
    std::uint64_t answers = 0;
    std::uint64_t booted_in = 0;  ///< the tick; 0: it did not
    bool named = false;
  };
  bool is_doubled(const Drive& drive) const;

  const Params& params_;
  app::CanNodes nodes_;
  Drive drive_[kMaxJoints];
  std::uint64_t ticks_ = 0;
  bool master_named_ = false;
  std::string news_;
};

}  // namespace verp::tool
