#include "common/protocol/device_end.hpp"

namespace verp::dxl {
namespace {

constexpr std::size_t kSyncHead = 4;  // address and length, common to all devices

}  // namespace

bool read_entry(const Packet& packet, std::size_t index, ReadEntry& entry) {
  const std::uint8_t* from = packet.parameters;
  switch (packet.instruction) {
    case Instruction::kSyncRead:
    case Instruction::kFastSyncRead:
      if (kSyncHead + index >= packet.size) return false;
      entry = {from[kSyncHead + index], get_u16(from), get_u16(from + 2)};
      return true;
    case Instruction::kBulkRead:
    case Instruction::kFastBulkRead:
      if (packet.size % kBulkEntryBytes != 0 || index >= packet.size / kBulkEntryBytes) {
        return false;
      }
      from += index * kBulkEntryBytes;
      entry = {from[0], get_u16(from + 1), get_u16(from + 3)};
      return true;
    default:
      return false;
  }
}

bool write_entry(const Packet& packet, std::size_t& offset, WriteEntry& entry) {
  const std::uint8_t* from = packet.parameters;
  if (packet.instruction == Instruction::kSyncWrite) {
    if (packet.size < kSyncHead) return false;
    if (offset == 0) offset = kSyncHead;
    const std::size_t length = get_u16(from + 2);
    if (offset + 1 + length > packet.size) return false;
    entry = {from[offset], get_u16(from), from + offset + 1, length};
    offset += 1 + length;
    return true;
  }
  if (packet.instruction != Instruction::kBulkWrite) return false;
  if (offset + kBulkEntryBytes > packet.size) return false;
  from += offset;
  const std::size_t length = get_u16(from + 3);
  if (offset + kBulkEntryBytes + length > packet.size) return false;
  entry = {from[0], get_u16(from + 1), from + kBulkEntryBytes, length};
  offset += kBulkEntryBytes + length;
  return true;
}

}  // namespace verp::dxl
