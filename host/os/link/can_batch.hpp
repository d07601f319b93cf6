#pragma once
#include <linux/can.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"

namespace verp::link {

canfd_frame to_kernel(const CanFrame& frame);
CanFrame from_kernel(const canfd_frame& raw, bool fd);

/// Data that the kernel delivers with a frame.
struct CanBeside {
  std::uint64_t wall_ns = 0;  ///< 0: missing
  std::uint32_t drops = 0;    ///< of the socket's queue, in total
  bool drops_told = false;
};
CanBeside read_beside(msghdr& message);

/// Frames and metadata of one kernel call.
struct CanBatch {
  static constexpr std::size_t kMost = 16;

  explicit CanBatch(std::size_t size);
  void expect_control();

  canfd_frame raw[kMost] = {};
  iovec part[kMost];
  alignas(cmsghdr) std::uint8_t control[kMost][128];
  mmsghdr message[kMost] = {};
};

}  // namespace verp::link
