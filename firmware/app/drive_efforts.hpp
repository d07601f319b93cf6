#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/can_nodes.hpp"
#include "firmware/app/joint_effort.hpp"

namespace verp::app {

/// Velocity (606Ch) and torque (6077h) of each drive, for observers: one SDO upload every
/// kEffortTicks ticks, first all velocities, then all torques. In TPDOs they would load the bus
/// beyond 70 % (21 drives at 125 Hz).
class DriveEfforts {
 public:
  explicit DriveEfforts(const Params& params) : params_(params) {}

  /// The next request; false: none is due. Skips drives in `busy`.
  bool next(CanFrame& frame, NodeMask busy) {
    if (++ticks_ < canopen::plan::kEffortTicks) return false;
    ticks_ = 0;
    if (!choose(busy)) return false;
    namespace sdo = canopen::sdo;
    asked_ = true;
    frame = sdo::addressed(canopen::sdo_request_id(node_id(params_, joint_)),
                           sdo::command(sdo::request::kUpload), object());
    return true;
  }

  /// Takes an SDO response; false: not to the last request.
  bool receive(int joint, const CanFrame& frame) {
    namespace sdo = canopen::sdo;
    if (!asked_ || joint != joint_ || frame.size != sdo::kFrameBytes ||
        !(sdo::address_of(frame) == object())) {
      return false;
    }
    const bool told = sdo::specifier_of(frame) == sdo::response::kUpload &&
                      (frame.data[0] & sdo::kExpedited) != 0;
    if (!told && frame.data[0] != sdo::kAbort) return false;
    asked_ = false;
    if (told) take(static_cast<std::uint32_t>(canopen::get_le(frame.data + 4, 4)));
    return true;
  }

  /// kMaxJoints elements.
  const JointEffort* efforts() const { return efforts_; }

 private:
  bool choose(NodeMask busy) {
    asked_ = false;
    for (int i = 0; i < params_.servo_count(); ++i) {
      joint_ = joint_ + 1 < params_.servo_count() ? joint_ + 1 : 0;
      if (joint_ == 0) torques_ = !torques_;
      if ((busy & node_bit(joint_)) == 0) return true;
    }
    return false;
  }
  canopen::Address object() const {
    namespace object = canopen::cia402::object;
    return torques_ ? object::kActualTorque : object::kActualVelocity;
  }
  void take(std::uint32_t value) {
    if (torques_) efforts_[joint_].torque = static_cast<std::int16_t>(value);
    if (!torques_) efforts_[joint_].velocity = static_cast<std::int32_t>(value);
  }

  const Params& params_;
  JointEffort efforts_[kMaxJoints];
  int joint_ = -1;
  std::uint8_t ticks_ = 0;
  bool torques_ = true;
  bool asked_ = false;
};

}  // namespace verp::app
