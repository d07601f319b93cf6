#include "host/os/link/can_interface.hpp"

#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "host/os/link/port.hpp"

namespace verp::link {
namespace {

using Kind = LinkError::Kind;

class Attributes {
 public:
  Attributes(const void* first, std::size_t size)
      : first_(static_cast<const std::uint8_t*>(first)), size_(size) {}
  explicit Attributes(const rtattr& outer) : Attributes(data(outer), RTA_PAYLOAD(&outer)) {}

  template <class Visitor>
  void each(Visitor&& visit) const {
    for (std::size_t at = 0; at + sizeof(rtattr) <= size_;) {
      const auto& one = *reinterpret_cast<const rtattr*>(first_ + at);
      if (one.rta_len < sizeof(rtattr) || at + one.rta_len > size_) return;
      visit(one);
      at += RTA_ALIGN(one.rta_len);
    }
  }
  static const void* data(const rtattr& one) {
    return reinterpret_cast<const std::uint8_t*>(&one) + RTA_LENGTH(0);
  }
  static std::uint32_t number(const rtattr& one) {
    std::uint32_t value = 0;
    if (RTA_PAYLOAD(&one) >= sizeof value) std::memcpy(&value, data(one), sizeof value);
    return value;
  }
  static std::string text(const rtattr& one) {
    const auto* first = static_cast<const char*>(data(one));
    return {first, ::strnlen(first, RTA_PAYLOAD(&one))};
  }

 private:
  const std::uint8_t* first_;
  std::size_t size_;
};

void read_can_data(const rtattr& data, CanInterface& interface) {
  Attributes(data).each([&](const rtattr& one) {
    if (one.rta_type == IFLA_CAN_RESTART_MS) interface.restart_ms = Attributes::number(one);
    // can_bittiming begins with the bit rate.
    if (one.rta_type == IFLA_CAN_BITTIMING) interface.bitrate = Attributes::number(one);
    if (one.rta_type == IFLA_CAN_STATE) {
      interface.bus_off = Attributes::number(one) == CAN_STATE_BUS_OFF;
    }
    if (one.rta_type == IFLA_CAN_BERR_COUNTER) {
      const std::uint32_t both = Attributes::number(one);  // can_berr_counter: two u16
      interface.send_errors = both & 0xFFFF;
      interface.receive_errors = both >> 16;
    }
  });
}

void read_link_info(const rtattr& info, CanInterface& interface) {
  std::string kind;
  Attributes(info).each([&](const rtattr& one) {
    if (one.rta_type == IFLA_INFO_KIND) kind = Attributes::text(one);
    if (one.rta_type == IFLA_INFO_DATA && kind == "can") read_can_data(one, interface);
  });
  interface.is_virtual = kind == "vcan" || kind == "vxcan";
}

CanInterface read_link(const nlmsghdr& message) {
  const auto& head = *static_cast<const ifinfomsg*>(NLMSG_DATA(&message));
  CanInterface interface;
  interface.index = head.ifi_index;
  interface.is_can = head.ifi_type == ARPHRD_CAN;
  interface.up = (head.ifi_flags & IFF_UP) != 0;
  Attributes(&head + 1, message.nlmsg_len - NLMSG_LENGTH(sizeof head)).each([&](const rtattr& one) {
    if (one.rta_type == IFLA_IFNAME) interface.name = Attributes::text(one);
    if (one.rta_type == IFLA_MTU) interface.fd = Attributes::number(one) == CANFD_MTU;
    if (one.rta_type == IFLA_LINKINFO) read_link_info(one, interface);
  });
  return interface;
}

[[noreturn]] void kernel_silent(int error) {
  throw LinkError(Kind::kUnsuitable, std::string("the kernel does not list its interfaces: ") +
                                         std::strerror(error) + "; see that `ip link` works");
}

std::string can_interfaces_here() {
  std::string names;
  for (const CanInterface& each : network_interfaces()) {
    if (each.is_can) names += " " + each.name;
  }
  return names.empty() ? "there is no CAN interface here" : "CAN interfaces here:" + names;
}

std::string how_to_make(const std::string& name) {
  if (name.starts_with("vcan")) {
    return "make it: sudo ip link add " + name + " type vcan && sudo ip link set " + name + " up";
  }
  if (name.starts_with("slcan")) {
    return "attach the serial adapter: sudo slcand -o -s8 /dev/ttyACM0 " + name +
           " && sudo ip link set " + name + " up";
  }
  return "is the adapter plugged in? " + can_interfaces_here();
}

}  // namespace

std::vector<CanInterface> network_interfaces() {
  const Descriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (socket.get() < 0) kernel_silent(errno);
  struct {
    nlmsghdr head{};
    ifinfomsg link{};
  } request;
  request.head.nlmsg_len = sizeof request;
  request.head.nlmsg_type = RTM_GETLINK;
  request.head.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
  if (::send(socket.get(), &request, sizeof request, 0) < 0) kernel_silent(errno);

  std::vector<CanInterface> all;
  alignas(nlmsghdr) std::array<std::uint8_t, 32768> buffer;  // most that the kernel fills
  for (;;) {
    const ssize_t count = ::recv(socket.get(), buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) kernel_silent(errno);
    auto left = static_cast<std::size_t>(count);
    for (auto* one = reinterpret_cast<nlmsghdr*>(buffer.data()); NLMSG_OK(one, left);
         one = NLMSG_NEXT(one, left)) {
      if (one->nlmsg_type == NLMSG_DONE) return all;
      if (one->nlmsg_type == NLMSG_ERROR) kernel_silent(EIO);
      if (one->nlmsg_type == RTM_NEWLINK) all.push_back(read_link(*one));
    }
  }
}

CanInterface find_can_interface(const std::string& name) {
  return find_can_interface(name, network_interfaces());
}

CanInterface find_can_interface(const std::string& name, const std::vector<CanInterface>& all) {
  const std::string head = "can:" + name + ": ";
  for (const CanInterface& each : all) {
    if (each.name != name) continue;
    if (!each.is_can) {
      throw LinkError(Kind::kUnsuitable, head + "is no CAN interface; " + can_interfaces_here());
    }
    if (each.up) return each;
    throw LinkError(Kind::kUnsuitable, head + down_trouble(each));
  }
  throw LinkError(Kind::kNoDevice, head + "no such interface; " + how_to_make(name));
}

std::string down_trouble(const CanInterface& interface) {
  const std::string set = "sudo ip link set " + interface.name;
  if (!interface.up) {
    const bool known = interface.is_virtual || interface.bitrate != 0;
    return "the interface is down; " + set + " up" +
           (known ? "" : " type can bitrate 1000000 restart-ms 100 (the rate of your bus)");
  }
  if (!interface.bus_off) return "";
  return "the interface is off the bus after too many errors; check that CAN-H and CAN-L are not "
         "swapped or shorted, two ends have 120 ohm, and all nodes have one bit rate, then: " +
         set + " down && " + set + " up";
}

std::string advice(const CanInterface& interface) {
  if (interface.is_virtual || interface.restart_ms != 0) return "";
  return "can:" + interface.name + ": after a bus-off it would stay away; sudo ip link set " +
         interface.name + " down && sudo ip link set " + interface.name +
         " up type can restart-ms 100";
}

std::string bit_rate_trouble(const CanInterface& interface, const std::string& robot,
                             std::uint32_t baud) {
  if (interface.bitrate == 0 || interface.bitrate == baud) return "";
  const std::string rate = std::to_string(baud);
  return interface.name + " runs at " + std::to_string(interface.bitrate) + " bit/s, the bus of " +
         robot + " at " + rate + "; ip link set " + interface.name + " down && ip link set " +
         interface.name + " up type can bitrate " + rate + ", or change baud in <verp:bus>";
}

}  // namespace verp::link
