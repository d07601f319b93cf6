#pragma once
#include <cstdint>

#include "firmware/app/contracts.hpp"
#include "firmware/app/dynamixel_device.hpp"
#include "firmware/app/operator_registers.hpp"

namespace verp::app {

extern template class DynamixelDevice<OperatorRegisters>;

/// The controller as a Dynamixel device on the operator's port; OperatorLink and Recorder of the
/// loop. Nothing waits: poll() serves the link in the loop's idle time, order() and record() in the
/// tick. `params`, `link` and `images` must outlive it. Orders expire: the core checks their age.
class OperatorDevice : public DynamixelDevice<OperatorRegisters> {
 public:
  OperatorDevice(hal::ByteLink& link, const Params& params, const OperatorSetup& setup,
                 Images& images = no_images)
      : DynamixelDevice(link, params, setup, images) {}

  /// Shows the bring-up's result to the operator; drops earlier orders.
  void brought_up(const BringUpReport& report);
  void show(table::StartFault fault) { registers_.report().start_fault(fault); }

  void show(table::ServoPower power) { registers_.report().servo_power(power); }
  void show(table::ImuCalibrationState state) { registers_.report().imu_calibration(state); }

  /// Call when the twin that played the servos is silent or gone: no servo can hold torque. The
  /// operator regains what torque blocks, such as a restart, until the next tick. Orders stay.
  void servos_gone() { registers_.report().servos_gone(); }

  /// `count`: actions in the loop's library; `fault`: why stored ones are not available.
  void offer_actions(int count, action::KeptFault fault = action::KeptFault::kNone);

  /// Call as often as the counters should refresh.
  void report(const LoopHealth& health) { registers_.report().health(health); }

  std::uint8_t id() const { return registers_.id(); }
  table::ImuSource imu_source() const { return registers_.imu_source(); }
  std::uint8_t torque_limit_percent() const { return registers_.torque_limit_percent(); }
  bool armed() const { return registers_.armed(); }
  table::ImuCalibrationOrder take_calibration_order();
  bool take_relax() { return registers_.take_relax(); }

  // OperatorLink
  OperatorOrder order(std::uint32_t tick);

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs);

 private:
  static constexpr int kMostSlices = 64;  ///< more than a port can hold

  // Bytes still in the link were sent earlier: take them first.
  void withdraw_orders();
};

}  // namespace verp::app
