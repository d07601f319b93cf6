#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/bus_options.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/can/client.hpp"

/// Objects of CANopen nodes as people name them and read their values.
namespace verp::tool {

/// One value of a node, with the name and type that a sheet has for it.
struct NodeObject {
  canopen::Address at;
  std::string name;                           ///< its address if no sheet has it
  std::optional<dxl::controller::Type> type;  ///< nothing: bytes
  bool writable = true;

  /// With a type only; this outlives what is returned.
  bus::NamedRegister as_register() const;
};

/// What the node's sheet names; nothing if it has none here.
std::vector<NodeObject> objects_of(const can::NodeIdentity& identity);

/// Of the controller's registers, and of what CiA 402 gives a unit for all drives alike; else
/// empty.
std::string_view unit_of(canopen::Address at);

/// INDEX:SUBINDEX; throws ToolError.
canopen::Address parse_object(const std::string& text);

/// What the words ask for, an array's name for its elements; all that is known of the node if they
/// name nothing. Throws ToolError if
/// nothing has that name, or more than one object.
std::vector<NodeObject> wanted(const BusOptions& options, const std::vector<NodeObject>& known);

/// As its type has it, else as bytes. For people what is made of fields, as COB-IDs and mapping
/// entries are, is hexadecimal.
std::string show_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes);
cli::Json json_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes);

}  // namespace verp::tool
