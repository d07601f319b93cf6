#pragma once
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/can_master.hpp"

namespace verp::app {

/// Runs a started transfer to its end; true on success. Drops other frames. `timeout_us`: for an
/// answer, at most SDO's own.
inline bool run_transfer(canopen::SdoClient& client, CanMaster& master,
                         std::uint32_t timeout_us = canopen::sdo::kTimeoutUs) {
  CanFrame frame;
  while (client.state() == canopen::SdoClient::State::kBusy) {
    while (client.next(frame, master.now_us())) master.send(frame);
    if (client.state() != canopen::SdoClient::State::kBusy) break;
    if (master.receive(frame, timeout_us)) {
      client.receive(frame, master.now_us());
    } else if (timeout_us < canopen::sdo::kTimeoutUs) {
      client.cancel(canopen::Abort::kTimeout);
    }
  }
  while (client.next(frame, master.now_us())) master.send(frame);  // our abort
  return client.state() == canopen::SdoClient::State::kDone;
}

}  // namespace verp::app
