#pragma once
#include <cstdint>

namespace verp::link {

/// An interface's errors, modulo 2^32. One error frame may count in several kinds. Source:
/// linux/can/error.h.
struct CanTrouble {
  std::uint32_t error_frames = 0;
  std::uint32_t bus_offs = 0;
  std::uint32_t restarts = 0;  ///< after a bus-off
  std::uint32_t lost_arbitrations = 0;
  std::uint32_t unacknowledged = 0;  ///< no other node, or rates differ
  std::uint32_t protocol = 0;        ///< bit, form, stuff errors, overload
  std::uint32_t bus_errors = 0;
  std::uint32_t transceiver = 0;  ///< broken or shorted wire
  std::uint32_t warnings = 0;     ///< an error counter passed 96
  std::uint32_t passives = 0;     ///< an error counter passed 127
  std::uint32_t send_timeouts = 0;
  std::uint32_t controller_overruns = 0;  ///< the controller had no room for received frames
  std::uint32_t socket_overruns = 0;      ///< this program read received frames too late
  std::uint32_t send_overflows = 0;
  std::uint32_t losses = 0;   ///< interface down or gone
  std::uint32_t dropped = 0;  ///< frames dropped by bus-off or loss
};

/// `kinds`: identifier without the flag; `data`: 8 bytes.
void count_error_frame(CanTrouble& trouble, std::uint32_t kinds, const std::uint8_t* data);

}  // namespace verp::link
