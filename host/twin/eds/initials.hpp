#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/protocol/canopen/drive_objects.hpp"
#include "host/twin/eds/eds.hpp"

/// Factory values, from two instances that differ only in node id: 1 and 2.
namespace verp::eds {

inline bool is_signed(DataType type) {
  return type == DataType::kInteger8 || type == DataType::kInteger16 ||
         type == DataType::kInteger32;
}

/// The value in EDS notation; empty: no value, or a text.
template <class Objects>
std::string initial_at(canopen::Address at, DataType type, Objects& of_node_1, Objects& of_node_2) {
  canopen::Entry entry;
  std::uint8_t bytes[2][8] = {};
  if (of_node_1.find(at, entry) != canopen::Abort::kNone || entry.max_size > 4) return "";
  if (of_node_1.read(at, 0, bytes[0], entry.max_size) != canopen::Abort::kNone) return "";
  of_node_2.read(at, 0, bytes[1], entry.max_size);
  const std::uint64_t first = canopen::get_le(bytes[0], 8);
  if (is_signed(type)) {
    const unsigned unused = 64 - 8 * entry.max_size;
    return fmt::format("{}", static_cast<std::int64_t>(first << unused) >> unused);
  }
  if (canopen::get_le(bytes[1], 8) == first) return fmt::format("0x{:X}", first);
  return fmt::format("$NODEID+0x{:X}", first - 1);
}

/// Values that change by themselves, and serial numbers, have no initial value.
inline bool has_initial(std::uint16_t index, const Value& value) {
  if (value.name == "Serial number" || value.type == DataType::kVisibleString) return false;
  if (value.commissioned) return false;
  return value.writable || index < 0x2000 ||
         index == canopen::cia402::object::kSupportedModes.index;
}

template <class Objects>
void fill_initials(std::vector<Object>& objects, Objects& of_node_1, Objects& of_node_2) {
  for (Object& object : objects) {
    if (object.count_writable) {
      std::uint8_t count = 0;
      of_node_1.read({object.index, 0}, 0, &count, 1);
      object.count_initial = count;
    }
    for (std::size_t i = 0; i < object.values.size(); ++i) {
      const std::size_t subindex = !object.has_members         ? 0
                                   : object.subindices.empty() ? i + 1
                                                               : object.subindices[i];
      const canopen::Address at{object.index, static_cast<std::uint8_t>(subindex)};
      Value& value = object.values[i];
      if (has_initial(object.index, value))
        value.initial = initial_at(at, value.type, of_node_1, of_node_2);
    }
  }
}

}  // namespace verp::eds
