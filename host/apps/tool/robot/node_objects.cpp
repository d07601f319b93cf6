#include "host/apps/tool/robot/node_objects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstring>
#include <utility>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/robot/register_value.hpp"
#include "host/twin/eds/eds.hpp"

namespace verp::tool {
namespace {

using canopen::Address;
using dxl::controller::Access;
using dxl::controller::Type;

/// Empty: bytes.
std::optional<Type> type_of(eds::DataType type) {
  using enum eds::DataType;
  constexpr std::pair<eds::DataType, Type> kTypes[] = {
      {kUnsigned8, Type::kU8},   {kUnsigned16, Type::kU16}, {kUnsigned32, Type::kU32},
      {kUnsigned64, Type::kU64}, {kInteger8, Type::kI8},    {kInteger16, Type::kI16},
      {kInteger32, Type::kI32},  {kReal32, Type::kF32},     {kVisibleString, Type::kText}};
  for (const auto& [theirs, ours] : kTypes) {
    if (theirs == type) return ours;
  }
  return std::nullopt;
}

bool parse_hex(std::string_view word, unsigned most, unsigned& value) {
  if (word.starts_with("0x") || word.starts_with("0X")) word.remove_prefix(2);
  const char* end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value, 16);
  return error == std::errc() && last == end && value <= most;
}

// Elements of an array; the EDS data names them "joint_velocity 1" and so on.
std::vector<NodeObject> elements_of(const std::vector<NodeObject>& known, const std::string& name) {
  std::vector<NodeObject> elements;
  for (const NodeObject& each : known) {
    if (each.at.subindex > 0 && each.name == fmt::format("{} {}", name, each.at.subindex)) {
      elements.push_back(each);
    }
  }
  return elements;
}

// EDS names need not be unique, for example COB-IDs. Rejects ambiguous ones; an array's name
// selects all elements.
std::vector<NodeObject> by_name(const std::vector<NodeObject>& known, const std::string& name) {
  std::vector<std::string> names, places;
  const NodeObject* found = nullptr;
  for (const NodeObject& each : known) {
    names.push_back(each.name);
    if (each.name != name) continue;
    found = &each;
    places.push_back(can::to_text(each.at));
  }
  if (places.size() > 1) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("'{}' is the name of {} objects: {}; give one of them "
                                     "by --object",
                                     name, places.size(), fmt::join(places, ", ")));
  }
  if (found != nullptr) return {*found};
  std::vector<NodeObject> elements = elements_of(known, name);
  if (!elements.empty()) return elements;
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("the node has no object named '{}'{}; give --object "
                                   "INDEX:SUBINDEX",
                                   name, cli::did_you_mean(name, names)));
}

bool fits(const NodeObject& object, const std::vector<std::uint8_t>& bytes) {
  return object.type &&
         (*object.type == Type::kText || bytes.size() == dxl::controller::type_bytes(*object.type));
}

/// 32-bit objects in 1000h to 1FFFh hold bit fields.
bool is_fields(const NodeObject& object) {
  return object.type == Type::kU32 && object.at.index >= 0x1000 && object.at.index <= 0x1FFF;
}

std::string as_bytes(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() > 8) return fmt::format("{} bytes", bytes.size());
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data(), bytes.size());
  return fmt::format("0x{:0{}X}", value, 2 * bytes.size());
}

}  // namespace

bus::NamedRegister NodeObject::as_register() const {
  return {.address = at.index,
          .name = name.c_str(),
          .type = *type,
          .access = writable ? Access::kWrite : Access::kRead};
}

std::vector<NodeObject> objects_of(const can::NodeIdentity& identity) {
  std::vector<NodeObject> all;
  for (const eds::Entry& each : eds::known_entries({.device_type = identity.device_type,
                                .vendor = identity.vendor.value_or(0),
                                .product = identity.product.value_or(0)})) {
    all.push_back({each.at, each.value.name, type_of(each.value.type), each.value.writable});
  }
  return all;
}

std::string_view unit_of(Address at) {
  constexpr std::pair<std::uint16_t, const char*> kDrive[] = {
      {0x6062, "counts"},  {0x6063, "counts"}, {0x6064, "counts"},  {0x607A, "counts"},
      {0x6071, "0.1 %"},   {0x6072, "0.1 %"},  {0x6073, "0.1 %"},   {0x6074, "0.1 %"},
      {0x6077, "0.1 %"},   {0x6078, "0.1 %"},  {0x6075, "0.001 A"}, {0x6076, "0.001 N m"},
      {0x6079, "0.001 V"}, {0x1017, "ms"},     {0x1006, "us"}};
  for (const auto& [index, unit] : kDrive) {
    if (at.index == index) return unit;
  }
  for (const dxl::controller::Register& each : dxl::controller::kTable) {
    if (each.object_index() == at.index && at.index >= 0x2000) return each.unit;
  }
  return "";
}

Address parse_object(const std::string& text) {
  const std::size_t colon = text.find(':');
  unsigned index = 0, sub = 0;
  const bool good = parse_hex(std::string_view(text).substr(0, colon), 0xFFFF, index) &&
                    (colon == std::string::npos ||
                     parse_hex(std::string_view(text).substr(colon + 1), 0xFF, sub));
  if (!good) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("--object: '{}' is no address; give INDEX:SUBINDEX, both "
                                     "hexadecimal, such as 6064:0",
                                     text));
  }
  return {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)};
}

std::vector<NodeObject> wanted(const BusOptions& options, const std::vector<NodeObject>& known) {
  std::vector<NodeObject> all;
  for (const std::string& name : options.names) {
    for (NodeObject& each : by_name(known, name)) all.push_back(std::move(each));
  }
  if (!options.object.empty()) {
    const Address at = parse_object(options.object);
    NodeObject one{at, can::to_text(at), std::nullopt};
    for (const NodeObject& each : known) {
      if (each.at == at) one = each;
    }
    all.push_back(one);
  }
  if (!all.empty()) return all;
  if (known.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         "its objects have no names here; give --object INDEX:SUBINDEX");
  }
  return known;
}

std::string show_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes) {
  if (!fits(object, bytes) || is_fields(object)) return as_bytes(bytes);
  return show_value(object.as_register(), bytes);
}

cli::Json json_value(const NodeObject& object, const std::vector<std::uint8_t>& bytes) {
  return fits(object, bytes) ? json_value(object.as_register(), bytes) : cli::Json(as_bytes(bytes));
}

}  // namespace verp::tool
