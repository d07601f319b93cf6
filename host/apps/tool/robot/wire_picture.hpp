#pragma once
#include <span>
#include <string>

#include "host/apps/tool/robot/wire_log.hpp"

namespace verp::tool {

/// A time that the picture shows as an arrow; in the packets' time.
struct WireSpan {
  double begin_us = 0, end_us = 0;
  std::string what;
};

/// As a logic analyser shows it, in SVG. On a serial line: the board's direction pin, the line with
/// its start, data and stop bits, and the decoded bytes; on CAN the frames. Time begins at the
/// first packet. Equal packets give equal bytes.
std::string draw_wire(const std::string& title, std::span<const WirePacket> packets,
                      const std::vector<WireSpan>& spans, bool can);

}  // namespace verp::tool
