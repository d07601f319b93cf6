#include "host/twin/can/other_nodes.hpp"

#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"

namespace verp::can {
namespace {

namespace plan = canopen::plan;

bool is_sign(const CanFrame& frame, const canopen::Connection& from, int slot) {
  std::uint8_t node = 0;
  canopen::NmtState state{};
  if (canopen::decode_heartbeat(frame, node, state)) return true;
  if (from.service == canopen::Service::kSdoResponse) {
    return frame.size == canopen::sdo::kFrameBytes;
  }
  if (from.service != canopen::Service::kTpdo) return false;
  if (app::is_joint(slot)) return from.number == 1 && frame.size == plan::kDriveAnswerBytes;
  if (slot == app::kImuNode) return from.number <= 2 && frame.size == plan::kImuAnswerBytes;
  return from.number == 1 && frame.size == plan::kFootAnswerBytes;
}

}  // namespace

void OtherNodes::take(const CanFrame& frame) {
  if (found_ != 0 || !canopen::is_canopen(frame)) return;
  const canopen::Connection from = canopen::connection_of(frame.id);
  const int slot = nodes_.slot_of(from.node);
  if (slot < 0) return;
  if (is_sign(frame, from, slot) && ++signs_[slot] == kSigns) found_ = from.node;
}

}  // namespace verp::can
