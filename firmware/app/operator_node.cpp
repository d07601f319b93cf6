#include "firmware/app/operator_node.hpp"

namespace verp::app {

OperatorNode::OperatorNode(hal::CanBus& bus, const Params& params, OperatorRegisters& registers,
                           Images& images)
    : bus_(bus),
      bus_imu_(params.imu.device_id != 0),
      registers_(registers),
      objects_(registers_, images),
      device_(objects_, controller_identity(), kNode) {
  publish_ticks(device_.objects(), kNode,
                canopen::plan::has_room_to_publish(params, !imu_on_bus()));
  device_.objects().producer.set_period_ms(canopen::plan::heartbeat_ms(params));
  device_.start();
  constexpr std::uint64_t kBegin_us = 0;  // the bus may not be open yet
  // As NMT master it must start itself.
  device_.receive(canopen::nmt_frame(canopen::NmtCommand::kStart, kNode), kBegin_us);
}

bool OperatorNode::poll(CanFrame& frame, std::uint32_t timeout_us) {
  for (int taken = 0; bus_.poll(frame, timeout_us); ++taken) {
    if (!is_for_node(frame)) return true;
    if (frame.id != kWatchers) ++asked_;
    device_.receive(frame, bus_.now_us());
    if (!ticks_) answer();
    if (taken == kMostTaken) return false;  // a flooded bus must not block
  }
  return false;
}

OperatorOrder OperatorNode::order(std::uint32_t tick) {
  if (registers_.slept_until(tick)) registers_.withdraw_orders();
  return registers_.order();
}

void OperatorNode::record(const TickRecord& record, const State& state, const Outputs& outputs) {
  registers_.record(record, state, outputs);
  tell(record.inputs);
}

void OperatorNode::tell(const Inputs& inputs) {
  ticks_ = true;
  publish(inputs);
  answer();
}

void OperatorNode::answer() {
  CanFrame frame;
  for (int sent = 0; sent < kMostAnswers && device_.next(frame, bus_.now_us()); ++sent) {
    bus_.send(frame);
  }
}

void OperatorNode::brought_up(const BringUpReport& report) {
  registers_.report().bring_up(report);
  registers_.withdraw_orders();
}

bool OperatorNode::is_for_node(const CanFrame& frame) {
  if (!canopen::is_canopen(frame)) return false;
  if (canopen::plan::is_to_controllers_sdo(frame.id)) return true;
  const canopen::Connection to = canopen::connection_of(frame.id);
  return to.node == kNode &&
         (to.service == canopen::Service::kSdoRequest || to.service == canopen::Service::kRpdo);
}

void OperatorNode::publish(const Inputs& inputs) {
  namespace published = canopen::published;
  parts_.find(before_, inputs, imu_on_bus());
  before_ = inputs;
  registers_.report().publish_flags(parts_.flags());
  send_pdo(published::kDigestPdo);
  send_pdo(published::kRecordPdo);
  for (int i = 0; i < parts_.count(); ++i) {
    registers_.report().publish_part(parts_.part(i).value());
    send_pdo(published::kPartPdo);
  }
}

void OperatorNode::send_pdo(unsigned number) {
  CanFrame frame;
  device_.trigger(number - 1);
  if (device_.next_pdo(number - 1, frame, bus_.now_us())) bus_.send(frame);
}

}  // namespace verp::app
