#pragma once
#include <cstdint>

/// CiA 301's generic pre-defined connection set: function code (four bits), node id (seven bits).
namespace verp::canopen {

inline constexpr std::uint8_t kMaxNode = 127;
inline constexpr std::uint8_t kPdosOfSet = 4;  ///< per direction

constexpr bool is_node(unsigned node) {
  return node >= 1 && node <= kMaxNode;
}

inline constexpr std::uint16_t kNmtId = 0x000;
inline constexpr std::uint16_t kSyncId = 0x080;
inline constexpr std::uint16_t kTimeId = 0x100;

constexpr std::uint16_t emcy_id(std::uint8_t node) {
  return static_cast<std::uint16_t>(0x080 + node);
}
/// `number` 1 to 4; from the device.
constexpr std::uint16_t tpdo_id(unsigned number, std::uint8_t node) {
  return static_cast<std::uint16_t>(0x080 + 0x100 * number + node);
}
/// `number` 1 to 4; to the device.
constexpr std::uint16_t rpdo_id(unsigned number, std::uint8_t node) {
  return static_cast<std::uint16_t>(0x100 + 0x100 * number + node);
}
/// From the device.
constexpr std::uint16_t sdo_response_id(std::uint8_t node) {
  return static_cast<std::uint16_t>(0x580 + node);
}
/// To the device.
constexpr std::uint16_t sdo_request_id(std::uint8_t node) {
  return static_cast<std::uint16_t>(0x600 + node);
}
/// Identifiers to and from the server.
struct SdoChannel {
  std::uint16_t request = 0;
  std::uint16_t response = 0;
  constexpr bool operator==(const SdoChannel&) const = default;
};
constexpr SdoChannel default_sdo(std::uint8_t node) {
  return {sdo_request_id(node), sdo_response_id(node)};
}
/// Channel `number`, from 1, in 1201h and on. Only one node of a bus may have any: two clients of a
/// channel take each other's answers. The predefined set leaves these identifiers free.
constexpr SdoChannel further_sdo(unsigned number) {
  return {static_cast<std::uint16_t>(0x6D0 + number), static_cast<std::uint16_t>(0x6C0 + number)};
}
constexpr std::uint16_t heartbeat_id(std::uint8_t node) {
  return static_cast<std::uint16_t>(0x700 + node);
}

enum class Service : std::uint8_t {
  kOther,
  kNmt,
  kSync,
  kTime,
  kEmcy,
  kTpdo,
  kRpdo,
  kSdoResponse,
  kSdoRequest,
  kHeartbeat,
};

struct Connection {
  Service service = Service::kOther;
  std::uint8_t node = 0;    ///< 0 for services without one
  std::uint8_t number = 0;  ///< of a PDO, 1 to 4
  constexpr bool operator==(const Connection&) const = default;
};

constexpr Connection connection_of(std::uint32_t id) {
  if (id == kNmtId) return {Service::kNmt};
  if (id == kSyncId) return {Service::kSync};
  if (id == kTimeId) return {Service::kTime};
  const auto node = static_cast<std::uint8_t>(id & 0x7F);
  if (node == 0 || id > 0x7FF) return {};
  const auto code = static_cast<std::uint8_t>(id >> 7);
  if (code == 1) return {Service::kEmcy, node};
  if (code >= 3 && code <= 10) {
    const auto number = static_cast<std::uint8_t>((code - 1) / 2);
    return {code % 2 == 1 ? Service::kTpdo : Service::kRpdo, node, number};
  }
  if (code == 11) return {Service::kSdoResponse, node};
  if (code == 12) return {Service::kSdoRequest, node};
  if (code == 14) return {Service::kHeartbeat, node};
  return {};
}

/// Identifiers closed to configurable services (SYNC, EMCY, PDO ...): CiA 301's list.
constexpr bool is_restricted(std::uint32_t id) {
  return id <= 0x07F || (id >= 0x101 && id <= 0x180) || (id >= 0x581 && id <= 0x5FF) ||
         (id >= 0x601 && id <= 0x67F) || (id >= 0x6E0 && id <= 0x6FF) || id >= 0x701;
}

}  // namespace verp::canopen
