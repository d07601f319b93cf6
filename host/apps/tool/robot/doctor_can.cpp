#include <fmt/format.h>

#include <algorithm>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/apps/tool/robot/doctor_bus.hpp"

namespace verp::tool {
namespace {

using canopen::plan::is_of_master;

constexpr std::uint32_t kListen_us = 300'000;
constexpr canopen::Address kErrorRegister{0x1001, 0};
constexpr std::uint32_t kManyErrors = 96;  // CAN: the controller warns from here on

/// Frames of others, heard while this program sends nothing.
struct Overheard {
  std::uint32_t frames = 0;
  std::uint32_t master_id = 0;
  bool master = false, two_masters = false;
};

Overheard overhear(hal::CanBus& wire) {
  Overheard heard;
  std::uint8_t counter = 0;
  CanFrame frame;
  for (const std::uint64_t end_us = wire.now_us() + kListen_us; wire.now_us() < end_us;) {
    if (!wire.poll(frame, kListen_us)) break;
    ++heard.frames;
    if (!is_of_master(frame)) continue;
    if (!heard.master) heard.master_id = frame.id;
    heard.master = true;
    if (frame.id != canopen::kSyncId || frame.size != 1) continue;
    const std::uint8_t next = frame.data[0];  // 1, 2, ... and 1 again
    if (counter != 0 && next != 1 && next != counter + 1) heard.two_masters = true;
    counter = next;
  }
  return heard;
}

void judge_node(can::Client& client, const can::NodeIdentity& node, const BusCase& bus,
                Findings& found) {
  const std::string check = fmt::format("id {}", node.node), name = bus.name_of(node.node);
  if (node.asked == can::NodeIdentity::Asked::kFellSilent) {
    return found.bad(check, name + " answered, then fell silent",
                     "check its supply, its plug and the termination");
  }
  if (bus.params) {
    for (int j = 0; j < bus.params->servo_count(); ++j) {
      const JointParams& joint = bus.params->joint[j];
      const std::uint32_t wanted = bus.params->servo[joint.servo_profile].model_number;
      if (joint.servo_id != node.node) continue;
      const bool drive = (node.device_type & 0xFFFF) == canopen::plan::kDriveProfile;
      if (drive && (wanted == 0 || node.product == wanted)) continue;
      found.bad(check,
                fmt::format("{} is no drive of product {}: type 0x{:X}, product {}", name, wanted,
                            node.device_type, node.product.value_or(0)),
                "correct its node id with its maker's tool, or its type in the robot's file");
    }
  }
  try {
    const auto errors = client.read(node.node, kErrorRegister);
    if (!errors.empty() && errors[0] != 0) {
      found.bad(check, fmt::format("{} reports an error (1001h is 0x{:02X})", name, errors[0]),
                fmt::format("see `verp bus read --link {} --id {}`, cure it, and switch it off and "
                            "on",
                            bus.link, node.node));
    }
  } catch (const bus::DeviceError& error) {
    found.bad(check, error.what(), "check its supply, its plug and the termination");
  }
}

void check_wire(const link::CanInterface& interface, const BusCase& bus, Findings& found) {
  if (bus.params) {
    const std::string trouble = link::bit_rate_trouble(interface, bus.model, bus.params->baud);
    if (!trouble.empty()) found.bad("bit rate", trouble);
  }
  const std::string advice = link::advice(interface);
  if (!advice.empty()) found.advise(interface.name, advice);
  if (std::max(interface.send_errors, interface.receive_errors) < kManyErrors) return;
  found.bad("errors",
            fmt::format("the interface counts {} errors of sending and {} of receiving",
                        interface.send_errors, interface.receive_errors),
            "give all nodes one bit rate, 120 ohm at both ends, and check CAN-H and CAN-L");
}

}  // namespace

void examine_nodes(hal::CanBus& wire, can::Client& client, const BusCase& bus, Findings& found) {
  const Overheard heard = overhear(wire);
  if (heard.two_masters) {
    return found.bad("bus", "two masters send SYNC; nothing was sent",
                     "end one: `verp run`, `verp hil`, or a controller on the robot");
  }
  if (heard.master) {
    return found.bad("bus",
                     fmt::format("another master commands this bus (identifier 0x{:03X}); nothing "
                                 "was sent",
                                 heard.master_id),
                     "end it: `verp run`, or a controller on the robot");
  }
  const auto nodes = client.scan();
  std::set<int> present;
  for (const can::NodeIdentity& each : nodes) present.insert(each.node);
  if (present.empty()) {
    return found.bad("silence",
                     heard.frames > 0 ? "frames come, and no node answers" : "no node answers",
                     "switch the drives' power on, give all nodes one bit rate, 120 ohm at both "
                     "ends, and check CAN-H and CAN-L");
  }
  const std::size_t before = found.size();
  for (const can::NodeIdentity& each : nodes) judge_node(client, each, bus, found);
  if (bus.robot) judge_missing(bus, present, found);
  judge_strangers(bus, present, found);
  if (found.size() == before) found.good("nodes", fmt::format("{} answer", present.size()));
}

void examine_can_bus(const Machine& machine, const BusCase& bus, Findings& found) {
  try {
    const link::CanInterface interface =
        link::find_can_interface(bus.endpoint.place, machine.interfaces());
    const std::string down = link::down_trouble(interface);
    if (!down.empty()) return found.bad(interface.name, down);
    check_wire(interface, bus, found);
    link::CanPort port(bus.endpoint);
    can::Client client(port, bus.endpoint, bus.timeout_us);
    examine_nodes(port, client, bus, found);
    const link::CanTrouble& trouble = port.trouble();
    if (trouble.unacknowledged == 0) return;
    found.bad("errors", fmt::format("nobody acknowledged {} of our frames", trouble.unacknowledged),
              "no other node has this bit rate, or the cable is open");
  } catch (const link::LinkError& error) {
    found.bad("link", error.what());
  } catch (const bus::DeviceError& error) {
    found.bad("link", error.what());
  }
}

}  // namespace verp::tool
