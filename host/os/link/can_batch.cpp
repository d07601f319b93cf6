#include "host/os/link/can_batch.hpp"

#include <algorithm>
#include <cstring>
#include <ctime>

namespace verp::link {

canfd_frame to_kernel(const CanFrame& frame) {
  canfd_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0) | (frame.remote ? CAN_RTR_FLAG : 0);
  raw.len = frame.size;
  if (frame.fd && frame.bit_rate_switch) raw.flags = CANFD_BRS;
  if (!frame.remote) std::memcpy(raw.data, frame.data, frame.size);
  return raw;
}

CanFrame from_kernel(const canfd_frame& raw, bool fd) {
  CanFrame frame;
  frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
  frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
  frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
  frame.fd = fd;
  frame.bit_rate_switch = fd && (raw.flags & CANFD_BRS) != 0;
  frame.size = std::min(raw.len, fd ? kMaxCanFdData : kMaxCanData);
  if (!frame.remote) std::memcpy(frame.data, raw.data, frame.size);
  return frame;
}

CanBeside read_beside(msghdr& message) {
  CanBeside beside;
  for (cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr; one = CMSG_NXTHDR(&message, one)) {
    if (one->cmsg_level != SOL_SOCKET) continue;
    if (one->cmsg_type == SO_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(one), sizeof stamp);
      beside.wall_ns = static_cast<std::uint64_t>(stamp.tv_sec) * 1'000'000'000 +
                       static_cast<std::uint64_t>(stamp.tv_nsec);
    }
    if (one->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&beside.drops, CMSG_DATA(one), sizeof beside.drops);
      beside.drops_told = true;
    }
  }
  return beside;
}

CanBatch::CanBatch(std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    part[i] = {&raw[i], sizeof raw[i]};
    message[i].msg_hdr.msg_iov = &part[i];
    message[i].msg_hdr.msg_iovlen = 1;
  }
}

void CanBatch::expect_control() {
  for (std::size_t i = 0; i < kMost; ++i) {
    message[i].msg_hdr.msg_control = control[i];
    message[i].msg_hdr.msg_controllen = sizeof control[i];
  }
}

}  // namespace verp::link
