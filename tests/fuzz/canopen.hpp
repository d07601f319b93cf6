#pragma once
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/sync.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace verp::fuzz {

/// A frame that some CANopen node might send to `node`, or any other one.
inline CanFrame frame_to(std::uint8_t node, Bytes& bytes) {
  const std::uint8_t kind = bytes.byte();
  // SDO request, SDO answer, RPDO 1 to 3, TPDO 1 and 2, heartbeat
  constexpr std::uint32_t kServices[] = {0x600, 0x580, 0x200, 0x300, 0x400, 0x180, 0x280, 0x700};
  CanFrame frame;
  frame.size = 8;
  frame.id = kServices[kind % 8] + node;
  if (kind % 16 == 8)
    return canopen::nmt_frame(static_cast<canopen::NmtCommand>(bytes.byte()), node);
  if (kind % 16 == 9) frame.id = canopen::kSyncId;
  if (kind % 16 == 9) frame.size = 1;
  if (kind % 16 > 12) {
    frame.id = bytes.word() & 0x7FF;
    frame.size = bytes.byte() % 9;
  }
  if (kind == 255) frame.extended = frame.remote = true;
  for (std::uint8_t i = 0; i < frame.size; ++i) frame.data[i] = bytes.byte();
  return frame;
}

}  // namespace verp::fuzz
