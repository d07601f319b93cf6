#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/apps/tool/robot/bus_options.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/can/client.hpp"

namespace verp::tool {

/// An object with name and type from the EDS data.
struct NodeObject {
  canopen::Address at;
  std::string name;                           ///< its address if the EDS data lacks it
  std::optional<dxl::controller::Type> type;  ///< empty: bytes
  bool writable = true;

  /// Needs `type`; refers to this object.
  bus::NamedRegister as_register() const;
};

/// Empty if the EDS data does not know the node.
std::vector<NodeObject> objects_of(const can::NodeIdentity& identity);

/// The unit of a controller register or a CiA 402 object; else empty.
std::string_view unit_of(canopen::Address at);

/// INDEX:SUBINDEX; throws ToolError.
canopen::Address parse_object(const std::string& text);

/// An array's name selects its elements; no name selects all known objects. Throws ToolError unless
/// each name fits exactly one.
std::vector<NodeObject> wanted(const BusOptions& options, const std::vector<NodeObject>& known);

/// Formats by type, else as bytes; bit fields such as COB-IDs in hexadecimal.
std::string show_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes);
cli::Json json_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes);

}  // namespace verp::tool
