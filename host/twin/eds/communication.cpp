#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "host/twin/eds/eds.hpp"

namespace verp::eds {
namespace {

constexpr DataType u8 = DataType::kUnsigned8, u16 = DataType::kUnsigned16,
                   u32 = DataType::kUnsigned32;

Object single(std::uint16_t index, Value value) {
  return {.index = index, .name = value.name, .values = {value}};
}
std::string hex(std::uint32_t value) {
  return fmt::format("0x{:X}", value);
}

Object array(std::uint16_t index, const std::string& name, std::size_t count, DataType type,
             bool writable) {
  Object object{.index = index, .name = name, .values = {}, .has_members = true, .is_array = true};
  for (std::size_t i = 1; i <= count; ++i) {
    object.values.push_back(
        {.name = fmt::format("{} {}", name, i), .type = type, .writable = writable});
  }
  return object;
}

Object identity_object(const canopen::Identity& identity) {
  return {.index = 0x1018,
          .name = "Identity object",
          .values = {{.name = "Vendor-ID", .type = u32, .initial = hex(identity.vendor)},
                     {.name = "Product code", .type = u32, .initial = hex(identity.product)},
                     {.name = "Revision number", .type = u32, .initial = hex(identity.revision)},
                     {.name = "Serial number", .type = u32}},
          .has_members = true};
}

// Subindex 4 is reserved; only TPDOs have a SYNC start value.
Object pdo_communication(bool receive, std::size_t number) {
  const unsigned base = receive ? 0x1400 : 0x1800;
  const std::size_t id = 0x100 * number + (receive ? 0x200 : 0x180);
  const std::string off =
      fmt::format("$NODEID+0x{:X}", canopen::kPdoInvalid | canopen::kPdoNoRemote | id);
  Object object{
      .index = static_cast<std::uint16_t>(base + number),
      .name = fmt::format("{} communication parameter {}", receive ? "RPDO" : "TPDO", number + 1),
      .values = {{.name = "COB-ID",
                  .type = u32,
                  .writable = true,
                  .initial = number < canopen::kPdosOfSet ? off : ""},
                 {.name = "Transmission type", .type = u8, .writable = true},
                 {.name = "Inhibit time", .type = u16, .writable = true},
                 {.name = "Event timer", .type = u16, .writable = true}},
      .has_members = true,
      .subindices = {1, 2, 3, 5}};
  if (receive) return object;
  object.values.push_back({.name = "SYNC start value", .type = u8, .writable = true});
  object.subindices.push_back(6);
  return object;
}

Object pdo_mapping(bool receive, std::size_t number, std::size_t entries) {
  const auto base = static_cast<std::uint16_t>(receive ? 0x1600 : 0x1A00);
  Object object =
      array(static_cast<std::uint16_t>(base + number),
            fmt::format("{} mapping parameter {}", receive ? "RPDO" : "TPDO", number + 1), entries,
            u32, true);
  object.is_array = false;
  object.count_writable = true;
  return object;
}

}  // namespace

DataType integer(unsigned bytes, bool is_signed) {
  switch (bytes) {
    case 1:
      return is_signed ? DataType::kInteger8 : DataType::kUnsigned8;
    case 2:
      return is_signed ? DataType::kInteger16 : DataType::kUnsigned16;
    case 4:
      return is_signed ? DataType::kInteger32 : DataType::kUnsigned32;
    default:
      return DataType::kUnsigned64;
  }
}

std::vector<Object> communication_objects(const canopen::DeviceSize& size,
                                          const canopen::Identity& identity) {
  std::vector<Object> objects;
  objects.push_back(
      single(0x1000, {.name = "Device type", .type = u32, .initial = hex(identity.device_type)}));
  objects.push_back(single(0x1001, {.name = "Error register", .type = u8}));
  objects.push_back(array(0x1003, "Pre-defined error field", canopen::kErrorHistory, u32, false));
  objects.back().count_writable = true;
  objects.push_back(single(
      0x1005, {.name = "COB-ID SYNC message", .type = u32, .initial = hex(canopen::kSyncId)}));
  objects.push_back(single(0x1008, {.name = "Manufacturer device name",
                                    .type = DataType::kVisibleString,
                                    .initial = identity.name}));
  for (const auto& [index, name] : {std::pair{std::uint16_t{0x1010}, "Store parameters"},
                                    {std::uint16_t{0x1011}, "Restore default parameters"}}) {
    if (!size.stores) break;
    objects.push_back(array(index, name, 1, u32, true));
    objects.back().values[0].name = "All parameters";
  }
  objects.push_back(
      single(0x1014, {.name = "COB-ID EMCY", .type = u32, .initial = "$NODEID+0x80"}));
  objects.push_back(array(0x1016, "Consumer heartbeat time", size.watched, u32, true));
  objects.push_back(
      single(0x1017, {.name = "Producer heartbeat time", .type = u16, .writable = size.beats}));
  objects.push_back(identity_object(identity));
  objects.push_back(
      single(0x1019, {.name = "Synchronous counter overflow value", .type = u8, .writable = true}));
  if (size.falls_back) {
    objects.push_back(array(0x1029, "Error behaviour", 1, u8, true));
    objects.back().values[0].name = "Communication error";
  }
  for (unsigned channel = 0; size.further_sdos > 0 && channel <= size.further_sdos; ++channel) {
    objects.push_back({.index = static_cast<std::uint16_t>(0x1200 + channel),
                       .name = fmt::format("SDO server parameter {}", channel + 1),
                       .values = {{.name = "COB-ID client to server", .type = u32},
                                  {.name = "COB-ID server to client", .type = u32}},
                       .has_members = true});
  }
  for (const bool receive : {true, false}) {
    const std::size_t count = receive ? size.rpdos : size.tpdos;
    for (std::size_t i = 0; i < count; ++i) objects.push_back(pdo_communication(receive, i));
    for (std::size_t i = 0; i < count; ++i) {
      objects.push_back(pdo_mapping(receive, i, size.entries));
    }
  }
  return objects;
}

}  // namespace verp::eds
