#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/feetech.hpp"
#include "firmware/app/request_master.hpp"

namespace verp::app {

struct FeetechWords {
  using Parser = feetech::Parser;
  using Packet = feetech::Packet;
  /// Requests and answers look alike: only our own bytes tell an echo on one wire.
  static bool answers(const Packet& packet, const std::uint8_t* request, std::size_t size) {
    return !packet.is(request, size);
  }
  static bool refuses(const Packet&) { return false; }  ///< its bits are the servo's state
  static std::uint32_t damaged(const Parser& parser) { return parser.checksum_errors(); }
};

using FeetechMaster = RequestMaster<FeetechWords>;
extern template class RequestMaster<FeetechWords>;

}  // namespace verp::app
