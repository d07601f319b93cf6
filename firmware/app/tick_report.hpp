#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "common/safety/limit.hpp"
#include "common/safety/machine.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/bus_counters.hpp"
#include "firmware/app/device_watch.hpp"
#include "firmware/app/joint_effort.hpp"
#include "firmware/app/register_image.hpp"
#include "hal/contract/byte_link.hpp"

namespace verp::app {

/// Loop counters that a tick's record lacks.
struct LoopHealth {
  BusCounters bus{};
  std::uint32_t bus_crc_errors = 0;
  std::uint32_t bus_noise_bytes = 0;
  std::uint32_t skipped_periods = 0;  ///< periods without a tick
  std::uint32_t imu_faults = 0;
  std::uint16_t battery_tenth_v = 0;     ///< measured by the board; 0: not measured
  const JointEffort* efforts = nullptr;  ///< null: not on this bus
};

class TickReport {
 public:
  TickReport(const Params& params, RegisterImage& image);
  void tick(const TickRecord& record, const State& state, const Outputs& outputs);

  /// The last tick's TPDOs (canopen/published_tick.hpp).
  void publish_flags(std::uint16_t flags) { image_.set(reg("inputs_flags"), flags); }
  void publish_part(std::uint64_t part) { image_.set(reg("inputs_part"), part); }

  /// Clears the torque registers: no servo can obey.
  void servos_gone();
  void bring_up(const BringUpReport& report);
  void start_fault(table::StartFault fault) { image_.set(reg("start_fault"), fault); }

  void imu_calibration(table::ImuCalibrationState state);
  void servo_power(table::ServoPower power) { image_.set(reg("servo_power"), power); }

  void health(const LoopHealth& health);
  void link(std::uint32_t crc_errors, const hal::LinkErrors& errors);
  void heard() { devices_.heard(); }

 private:
  static constexpr std::uint8_t kNobody = 255;

  std::uint8_t refused_joint(const Inputs& inputs, const Outputs& outputs) const;
  void take_telemetry(const Inputs& inputs);

  const Params& params_;
  RegisterImage& image_;
  DeviceWatch devices_;
  std::uint16_t battery_tenth_v_ = 0;
};

}  // namespace verp::app
