#pragma once
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "host/os/link/can_port.hpp"

/// Needs tests/support/with-can.
namespace verp::test {

/// Another node: plain sockets, none of our code.
class RawNode {
 public:
  explicit RawNode(const std::string& interface)
      : socket_(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW)) {
    const int on = 1;
    ::setsockopt(socket_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
    EXPECT_NE(address.can_ifindex, 0) << interface << ": run this inside tests/support/with-can";
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~RawNode() { ::close(socket_); }
  RawNode(const RawNode&) = delete;
  RawNode& operator=(const RawNode&) = delete;

  void send(const CanFrame& frame) {
    canfd_frame raw{};
    raw.can_id = frame.id;
    if (frame.extended) raw.can_id |= CAN_EFF_FLAG;
    if (frame.remote) raw.can_id |= CAN_RTR_FLAG;
    raw.len = frame.size;
    raw.flags = frame.bit_rate_switch ? CANFD_BRS : 0;
    std::memcpy(raw.data, frame.data, sizeof raw.data);
    send_raw(raw, frame.fd ? CANFD_MTU : CAN_MTU);
  }
  /// As a driver reports it; vcan carries it.
  void send_error(std::uint32_t kinds, std::uint8_t controller = 0) {
    canfd_frame raw{};
    raw.can_id = CAN_ERR_FLAG | kinds;
    raw.len = 8;
    raw.data[1] = controller;
    send_raw(raw, CAN_MTU);
  }
  /// Kernel threads carry frames, which may take a while.
  bool take(CanFrame& frame) {
    canfd_frame raw{};
    pollfd one{socket_, POLLIN, 0};
    if (::poll(&one, 1, 50) <= 0) return false;
    const ssize_t count = ::read(socket_, &raw, sizeof raw);
    if (count < 0) return false;
    frame = {};
    frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    frame.fd = count == CANFD_MTU;
    frame.bit_rate_switch = frame.fd && (raw.flags & CANFD_BRS) != 0;
    frame.id = raw.can_id & (frame.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame.size = raw.len;
    std::memcpy(frame.data, raw.data, raw.len);
    return true;
  }

 private:
  void send_raw(const canfd_frame& raw, std::size_t size) {
    EXPECT_EQ(::write(socket_, &raw, size), static_cast<ssize_t>(size)) << std::strerror(errno);
  }
  int socket_;
};

struct Vcan {
  static constexpr std::uint32_t kPlenty_us = 100'000;
  static constexpr std::uint64_t kSlack_us = 50'000;  // the virtual machine may be late
  static constexpr bool kBusOff = false;              // no wire, so nothing waits
  void far_send(const CanFrame& frame) { far.send(frame); }
  bool far_take(CanFrame& frame) { return far.take(frame); }
  void fill_and_bus_off(const CanFrame&, int) {}
  RawNode far{"vcan0"};
  link::CanPort bus{link::parse_endpoint("can:vcan0")};
};

using CanBuses = ::testing::Types<Vcan>;

}  // namespace verp::test
