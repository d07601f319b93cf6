#include "firmware/app/drive_telemetry.hpp"

#include "common/protocol/canopen/cia402.hpp"
#include "common/protocol/control_table.hpp"

namespace verp::app {

std::uint8_t hardware_error_of(std::uint16_t code) {
  if (code == 0) return 0;
  if (code >> 8 == 0x31 || code >> 8 == 0x32) return dxl::kInputVoltageError;
  if (code >> 12 == 0x4) return dxl::kOverheatingError;
  if (code >> 12 == 0x2) return dxl::kElectricalShockError;
  if (code >> 8 == 0x73) return dxl::kEncoderError;
  return dxl::kOverloadError;
}

bool DriveTelemetry::next(CanFrame& frame, NodeMask busy, bool& missed) {
  missed = asked_ >= 0;
  if (missed || !more_ || is_in(busy, joint_)) choose(busy);
  more_ = false;
  asked_ = -1;
  if (params_.servo_count() == 0 || is_in(busy, joint_)) return false;
  asked_ = joint_;
  at_ = object();
  namespace sdo = canopen::sdo;
  frame = sdo::addressed(canopen::sdo_request_id(node_id(params_, joint_)),
                         sdo::command(sdo::request::kUpload), at_);
  return true;
}

bool DriveTelemetry::receive(int joint, const CanFrame& frame) {
  namespace sdo = canopen::sdo;
  if (joint != asked_ || frame.size != sdo::kFrameBytes || !(sdo::address_of(frame) == at_)) {
    return false;
  }
  const auto value = static_cast<std::uint32_t>(canopen::get_le(frame.data + 4, 4));
  if (frame.data[0] == sdo::kAbort) {
    take_abort(joint, static_cast<canopen::Abort>(value));
  } else if (sdo::specifier_of(frame) == sdo::response::kUpload &&
             (frame.data[0] & sdo::kExpedited) != 0) {
    take(value);
  } else {
    return false;
  }
  return true;
}

void DriveTelemetry::put(Inputs& inputs) {
  if (!fresh_) return;
  fresh_ = false;
  inputs.slow_joint = static_cast<std::uint8_t>(joint_);
  inputs.slow_voltage_tenth_v = value_.voltage_tenth_v;
  inputs.slow_temperature_c = value_.temperature_c;
  inputs.slow_error = value_.errors;
  inputs.flags |= kSlowFresh;
}

void DriveTelemetry::choose(NodeMask busy) {
  if (urgent_ >= 0 && !is_in(busy, urgent_)) {
    joint_ = urgent_;
    urgent_ = -1;
  } else {
    for (int i = 0; i < params_.servo_count(); ++i) {
      joint_ = joint_ + 1 < params_.servo_count() ? joint_ + 1 : 0;
      if (!is_in(busy, joint_)) break;
    }
  }
  part_ = (plain_ >> joint_ & 1) != 0 ? Part::kVoltage : Part::kAll;
}

canopen::Address DriveTelemetry::object() const {
  namespace object = canopen::cia402::object;
  if (part_ == Part::kAll) return canopen::plan::kTelemetry;
  return part_ == Part::kVoltage ? object::kDcLinkVoltage : object::kErrorCode;
}

void DriveTelemetry::take_abort(int joint, canopen::Abort why) {
  asked_ = -1;
  const bool absent = why == canopen::Abort::kNoObject || why == canopen::Abort::kNoSubindex;
  if (part_ != Part::kAll || !absent) return;
  plain_ |= 1u << joint;
  part_ = Part::kVoltage;
  more_ = true;
}

void DriveTelemetry::take(std::uint32_t value) {
  asked_ = -1;
  if (part_ == Part::kAll) value_ = canopen::plan::Telemetry::from(value);
  if (part_ == Part::kVoltage) {
    const std::uint32_t tenths = value / 100;
    value_ = {static_cast<std::uint16_t>(tenths < 0xFFFF ? tenths : 0xFFFF), 0, 0};
    part_ = Part::kError;
    more_ = true;
    return;
  }
  if (part_ == Part::kError) value_.errors = hardware_error_of(static_cast<std::uint16_t>(value));
  fresh_ = true;
}

}  // namespace verp::app
