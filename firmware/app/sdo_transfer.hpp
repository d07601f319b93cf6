#pragma once
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/can_master.hpp"

namespace verp::app {

/// Pumps the client's transfer, which has begun, to its end; true if it was good. What else comes
/// meanwhile is dropped. An answer may take `timeout_us`, or SDO's own patience if that is shorter.
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
  while (client.next(frame, master.now_us())) master.send(frame);  // an abort of ours
  return client.state() == canopen::SdoClient::State::kDone;
}

}  // namespace verp::app
