#include "firmware/app/operator_device.hpp"

namespace verp::app {

template class DynamixelDevice<OperatorRegisters>;

void OperatorDevice::brought_up(const BringUpReport& report) {
  registers_.report().bring_up(report);
  withdraw_orders();
}

void OperatorDevice::offer_actions(int count, action::KeptFault fault) {
  registers_.offer_actions(count, fault);
}

table::ImuCalibrationOrder OperatorDevice::take_calibration_order() {
  return registers_.take_calibration_order();
}

OperatorOrder OperatorDevice::order(std::uint32_t tick) {
  if (registers_.slept_until(tick)) withdraw_orders();
  return registers_.order();
}

void OperatorDevice::record(const TickRecord& record, const State& state, const Outputs& outputs) {
  registers_.record(record, state, outputs);
}

void OperatorDevice::withdraw_orders() {
  for (int slice = 0; slice < kMostSlices && poll(); ++slice) {
  }
  registers_.withdraw_orders();
}

}  // namespace verp::app
