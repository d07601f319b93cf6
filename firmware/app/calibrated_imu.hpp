#pragma once
#include <cstddef>
#include <cstdint>

#include "firmware/app/imu_calibration.hpp"
#include "hal/contract/imu.hpp"
#include "hal/contract/store.hpp"

namespace verp::app {

inline constexpr std::uint16_t kImuCalibrationKey = 2;  ///< in the board's Store

/// An Imu that corrects samples by the calibration in the board's Store, and can measure a new one.
template <hal::Imu Chip, hal::Store Memory>
class CalibratedImu {
 public:
  CalibratedImu(Chip& chip, Memory& memory, const ImuParams& imu)
      : chip_(chip), memory_(memory), basis_(basis_of(imu)), calibrator_(imu) {}

  /// Call at start. A calibration for another scale or mounting is ignored but stays stored, as
  /// that robot may return.
  void load() {
    std::uint8_t bytes[ImuCalibration::kBytes];
    const std::size_t size = memory_.get(kImuCalibrationKey, bytes, sizeof bytes);
    if (size == 0) return;
    const bool ours = size == sizeof bytes && calibration_.decode(bytes, basis_);
    state_ = ours ? State::kDone : State::kDropped;
  }

  hal::ImuStatus read(hal::ImuSample& sample) {
    hal::ImuSample raw;
    const hal::ImuStatus status = chip_.read(raw);
    if (status != hal::ImuStatus::kFresh) return status;
    if (calibrator_.take(raw)) finish();
    sample = calibration_.corrected(raw);
    return status;
  }
  std::uint32_t faults() const { return chip_.faults(); }

  /// Twice the time of all samples at the longest period, 20 ms. Samples come only with read(): a
  /// silent chip, or a loop that does not read it, must not measure for ever.
  static constexpr std::uint64_t kMost_us = 2 * ImuCalibrator::kSamples * std::uint64_t{20'000};

  /// Starts a measurement: the robot must stand upright and still, torque off. The old calibration
  /// applies until the end.
  void measure(std::uint64_t now_us) {
    calibrator_.begin();
    state_ = State::kMeasuring;
    end_us_ = now_us + kMost_us;
  }
  /// Call regularly: ends a measurement that lacks samples.
  void watch(std::uint64_t now_us) {
    if (calibrator_.state() != State::kMeasuring || now_us < end_us_) return;
    calibrator_.stop();
    state_ = State::kSilent;
  }
  /// Call before torque comes on: the calibration must not change under a standing robot.
  void abandon() {
    if (calibrator_.state() != State::kMeasuring) return;
    calibrator_.stop();
    state_ = State::kMoved;
  }
  void forget() {
    calibrator_.stop();
    calibration_ = {};
    state_ = State::kNone;
    unkept_ = Unkept::kRemoval;
  }
  /// Call regularly: passes a change to the Store, whose work() runs elsewhere.
  void keep() {
    if (unkept_ == Unkept::kNothing) return;
    std::uint8_t bytes[ImuCalibration::kBytes];
    calibration_.encode(bytes, basis_);
    const std::size_t size = unkept_ == Unkept::kRemoval ? 0 : sizeof bytes;
    if (memory_.put(kImuCalibrationKey, bytes, size) == hal::PutResult::kBusy) return;
    unkept_ = Unkept::kNothing;
  }
  dxl::controller::ImuCalibrationState state() const { return state_; }

 private:
  using State = dxl::controller::ImuCalibrationState;
  enum class Unkept : std::uint8_t { kNothing, kValue, kRemoval };

  void finish() {
    state_ = calibrator_.state();
    if (state_ != State::kDone) return;
    calibration_ = calibrator_.result();
    unkept_ = Unkept::kValue;
  }

  Chip& chip_;
  Memory& memory_;
  const std::uint32_t basis_;
  std::uint64_t end_us_ = 0;  ///< latest end of the measurement
  ImuCalibrator calibrator_;
  ImuCalibration calibration_;
  State state_ = State::kNone;
  Unkept unkept_ = Unkept::kNothing;
};

}  // namespace verp::app
