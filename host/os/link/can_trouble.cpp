#include "host/os/link/can_trouble.hpp"

#include <linux/can/error.h>

namespace verp::link {

void count_error_frame(CanTrouble& trouble, std::uint32_t kinds, const std::uint8_t* data) {
  const std::uint8_t controller = (kinds & CAN_ERR_CRTL) != 0 ? data[1] : 0;
  const auto count = [](std::uint32_t& counter, std::uint32_t flags) {
    if (flags != 0) ++counter;
  };
  ++trouble.error_frames;
  count(trouble.bus_offs, kinds & CAN_ERR_BUSOFF);
  count(trouble.restarts, kinds & CAN_ERR_RESTARTED);
  count(trouble.lost_arbitrations, kinds & CAN_ERR_LOSTARB);
  count(trouble.unacknowledged, kinds & CAN_ERR_ACK);
  count(trouble.protocol, kinds & CAN_ERR_PROT);
  count(trouble.bus_errors, kinds & CAN_ERR_BUSERROR);
  count(trouble.transceiver, kinds & CAN_ERR_TRX);
  count(trouble.send_timeouts, kinds & CAN_ERR_TX_TIMEOUT);
  count(trouble.warnings, controller & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING));
  count(trouble.passives, controller & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE));
  count(trouble.controller_overruns, controller & CAN_ERR_CRTL_RX_OVERFLOW);
  count(trouble.send_overflows, controller & CAN_ERR_CRTL_TX_OVERFLOW);
}

}  // namespace verp::link
