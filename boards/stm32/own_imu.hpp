#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/model/params.hpp"
#include "firmware/app/app.hpp"
#include "firmware/app/calibrated_imu.hpp"
#include "hal/chip/invensense/motion_sensor.hpp"
#include "hal/chip/invensense/ranges.hpp"
#include "hal/chip/stm32/spi_master.hpp"

/// The board's own IMU, if its scales match the robot's Params.
namespace verp::board {

using app::table::ImuCalibrationOrder;
using app::table::ImuCalibrationState;

/// For a board without one. `Log` is the board's Store.
template <bool kOnBoard, class Log>
class OwnImu {
 public:
  using Chip = app::NoImu;

  OwnImu(const Params&, Log&) {}
  void open(const Start&) {}
  void offer(app::OperatorSetup&) const {}
  void serve(ImuCalibrationOrder, bool) {}
  Chip* chip() { return nullptr; }
  std::uint32_t faults() const { return 0; }
  ImuCalibrationState calibration() const { return ImuCalibrationState::kNone; }
};

template <class Log>
class OwnImu<true, Log> {
  using Spi = stm32::SpiMaster<Io, Timer>;
  using Sensor = hal::invensense::MotionSensor<Spi, Timer>;

 public:
  using Chip = app::CalibratedImu<Sensor, Log>;

  OwnImu(const Params& params, Log& log)
      : fits_(hal::invensense::choose_ranges(params.imu.gyro_rad_s_per_count,
                                             params.imu.accel_m_s2_per_count, ranges_)),
        on_bus_(params.imu.device_id != 0),
        spi_(kFamily, kImu.wiring, timer),
        sensor_(spi_, timer, ranges_),
        chip_(sensor_, log, params.imu) {}

  void open(const Start& start) {
    spi_.open(kImu.on_apb2 ? start.clocks.apb2_hz : start.clocks.apb1_hz);
    chip_.load();
  }
  /// Call before loading the settings: sets the IMU sources on offer.
  void offer(app::OperatorSetup& setup) const {
    using app::table::ImuSource;
    if (!fits_) return;
    setup.imu_sources |= 1 << static_cast<int>(ImuSource::kChip);
    if (on_bus_) return;
    setup.imu_sources = 1 << static_cast<int>(ImuSource::kChip);
    setup.imu_source = ImuSource::kChip;
  }
  /// Call regularly: executes the operator's calibration order; stores the result.
  void serve(ImuCalibrationOrder order, bool armed) {
    if (armed) chip_.abandon();
    if (order == ImuCalibrationOrder::kMeasure) chip_.measure(timer.now_us());
    if (order == ImuCalibrationOrder::kForget) chip_.forget();
    chip_.watch(timer.now_us());
    chip_.keep();
  }
  Chip* chip() { return fits_ ? &chip_ : nullptr; }
  std::uint32_t faults() const { return chip_.faults(); }
  ImuCalibrationState calibration() const { return chip_.state(); }

 private:
  hal::invensense::Ranges ranges_;
  bool fits_;
  bool on_bus_;
  Spi spi_;
  Sensor sensor_;
  Chip chip_;
};

}  // namespace verp::board
