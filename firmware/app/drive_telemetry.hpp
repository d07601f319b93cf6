#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/canopen_bring_up.hpp"

namespace verp::app {

/// Slow telemetry: at the end of each tick an expedited SDO upload from one drive, whose answer the
/// next tick takes. A drive without kTelemetry is asked for voltage and error code instead and
/// reports no temperature. A drive without those reports nothing.
class DriveTelemetry {
 public:
  explicit DriveTelemetry(const Params& params) : params_(params) {}

  void set_foreign(std::uint32_t drives) { plain_ = drives; }
  /// Asks this drive next: it has something to report.
  void hurry(int joint) { urgent_ = joint; }

  NodeMask asked() const { return asked_ < 0 ? 0 : node_bit(asked_); }

  /// The next request; false: there is no request. Skips drives in `busy`: each answer also proves
  /// that the bus is prompt. `missed`: the last request had no answer.
  bool next(CanFrame& frame, NodeMask busy, bool& missed) {
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

  /// Takes an SDO response; false: not to the last request.
  bool receive(int joint, const CanFrame& frame) {
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

  void put(Inputs& inputs) {
    if (!fresh_) return;
    fresh_ = false;
    inputs.slow_joint = static_cast<std::uint8_t>(joint_);
    inputs.slow_voltage_tenth_v = value_.voltage_tenth_v;
    inputs.slow_temperature_c = value_.temperature_c;
    inputs.slow_error = value_.errors;
    inputs.flags |= kSlowFresh;
  }

 private:
  enum class Part : std::uint8_t { kAll, kVoltage, kError };

  static bool is_in(NodeMask mask, int joint) { return (mask & node_bit(joint)) != 0; }
  void choose(NodeMask busy) {
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
  canopen::Address object() const {
    namespace object = canopen::cia402::object;
    if (part_ == Part::kAll) return canopen::plan::kTelemetry;
    return part_ == Part::kVoltage ? object::kDcLinkVoltage : object::kErrorCode;
  }
  // A drive that cannot answer now is asked again in its next turn.
  void take_abort(int joint, canopen::Abort why) {
    asked_ = -1;
    const bool absent = why == canopen::Abort::kNoObject || why == canopen::Abort::kNoSubindex;
    if (part_ != Part::kAll || !absent) return;
    plain_ |= 1u << joint;
    part_ = Part::kVoltage;
    more_ = true;
  }
  void take(std::uint32_t value) {
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

  const Params& params_;
  int joint_ = 0;
  int asked_ = -1;
  int urgent_ = -1;
  std::uint32_t plain_ = 0;
  Part part_ = Part::kAll;
  bool more_ = false;  ///< ask the same drive again
  bool fresh_ = false;
  canopen::Address at_;
  canopen::plan::Telemetry value_;
};

}  // namespace verp::app
