#pragma once
#include <optional>
#include <set>
#include <string>

#include "common/model/params.hpp"
#include "host/apps/tool/robot/doctor_machine.hpp"
#include "host/apps/tool/robot/doctor_report.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/robot/model/entity.hpp"
#include "host/twin/can/client.hpp"

/// `verp bus doctor`: names the cause of silence or garbage on a servo bus. It only pings and
/// reads. While another master talks it sends nothing.
namespace verp::tool {

/// The bus, and the robot that should be on it.
struct BusCase {
  std::string link;
  link::Endpoint endpoint;
  std::uint32_t timeout_us = 0;
  std::string model = {};  ///< as the user named it
  std::string bus = {};    ///< likewise; empty: the first
  BusProtocol protocol = BusProtocol::kDynamixel2;
  std::optional<model::Entity> robot = {};  ///< none: judges only what answers
  std::optional<Params> params = {};        ///< with `robot`

  /// "l_knee (id 14)", or "id 14".
  std::string name_of(int id) const;
  /// The command that sets this device up. `wired`: it has its id and is not alone on the bus.
  std::string set_up(int id, bool wired) const;
};

void examine_serial_bus(const Machine& machine, const BusCase& bus, Findings& found);
void examine_can_bus(const Machine& machine, const BusCase& bus, Findings& found);
/// The nodes on an open CAN bus, whose client is given.
void examine_nodes(hal::CanBus& wire, can::Client& client, const BusCase& bus, Findings& found);

/// Ids of the robot's servos and sensors.
std::set<int> devices_of(const BusCase& bus);
/// Names the devices of the robot that do not answer, and the cable where they begin.
void judge_missing(const BusCase& bus, const std::set<int>& present, Findings& found);
/// Devices that answer and are not the robot's.
void judge_strangers(const BusCase& bus, const std::set<int>& present, Findings& found);

}  // namespace verp::tool
