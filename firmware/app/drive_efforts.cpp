#include "firmware/app/drive_efforts.hpp"

namespace verp::app {

bool DriveEfforts::next(CanFrame& frame, NodeMask busy) {
  if (++ticks_ < canopen::plan::kEffortTicks) return false;
  ticks_ = 0;
  if (!choose(busy)) return false;
  namespace sdo = canopen::sdo;
  asked_ = true;
  frame = sdo::addressed(canopen::sdo_request_id(node_id(params_, joint_)),
                         sdo::command(sdo::request::kUpload), object());
  return true;
}

bool DriveEfforts::receive(int joint, const CanFrame& frame) {
  namespace sdo = canopen::sdo;
  if (!asked_ || joint != joint_ || frame.size != sdo::kFrameBytes ||
      !(sdo::address_of(frame) == object())) {
    return false;
  }
  const bool told =
      sdo::specifier_of(frame) == sdo::response::kUpload && (frame.data[0] & sdo::kExpedited) != 0;
  if (!told && frame.data[0] != sdo::kAbort) return false;
  asked_ = false;
  if (told) take(static_cast<std::uint32_t>(canopen::get_le(frame.data + 4, 4)));
  return true;
}

bool DriveEfforts::choose(NodeMask busy) {
  asked_ = false;
  for (int i = 0; i < params_.servo_count(); ++i) {
    joint_ = joint_ + 1 < params_.servo_count() ? joint_ + 1 : 0;
    if (joint_ == 0) torques_ = !torques_;
    if ((busy & node_bit(joint_)) == 0) return true;
  }
  return false;
}

canopen::Address DriveEfforts::object() const {
  namespace object = canopen::cia402::object;
  return torques_ ? object::kActualTorque : object::kActualVelocity;
}

void DriveEfforts::take(std::uint32_t value) {
  if (torques_) efforts_[joint_].torque = static_cast<std::int16_t>(value);
  if (!torques_) efforts_[joint_].velocity = static_cast<std::int32_t>(value);
}

}  // namespace verp::app
