#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/request_master.hpp"

namespace verp::app {

struct DynamixelWords {
  using Parser = dxl::Parser;
  using Packet = dxl::Packet;
  static bool answers(const Packet& packet, const std::uint8_t*, std::size_t) {
    return packet.is_status();
  }
  static bool refuses(const Packet& packet) {
    return !packet.is_fast_reply() && (packet.error & ~dxl::kAlert) != 0;
  }
  static std::uint32_t damaged(const Parser& parser) { return parser.crc_errors(); }
};

using BusMaster = RequestMaster<DynamixelWords>;
extern template class RequestMaster<DynamixelWords>;

}  // namespace verp::app
