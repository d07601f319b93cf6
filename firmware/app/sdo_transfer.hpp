#pragma once
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/can_master.hpp"

namespace verp::app {

/// Runs the client's started transfer to its end; true on success. Drops other frames meanwhile. An
/// answer may take `timeout_us`, at most SDO's own timeout.
template <hal::CanBus Bus>
bool run_transfer(canopen::SdoClient& client, CanMaster<Bus>& master,
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
  while (client.next(frame, master.now_us())) master.send(frame);  // sends our abort
  return client.state() == canopen::SdoClient::State::kDone;
}

}  // namespace verp::app
