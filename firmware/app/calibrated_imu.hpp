#pragma once
#include <cstddef>
#include <cstdint>

#include "firmware/app/imu_calibration.hpp"
#include "hal/contract/imu.hpp"
#include "hal/contract/store.hpp"

namespace verp::app {

inline constexpr std::uint16_t kImuCalibrationKey = 2;  ///< in the board's Store

/// An Imu whose samples are corrected by the calibration kept in the board's Store; it can measure
/// a new one from the samples that pass through.
template <hal::Imu Chip, hal::Store Memory>
class CalibratedImu {
 public:
  CalibratedImu(Chip& chip, Memory& memory, const ImuParams& imu)
      : chip_(chip), memory_(memory), calibrator_(imu) {}

  /// At the start: takes what was kept.
  void load() {
    std::uint8_t bytes[ImuCalibration::kBytes];
    if (memory_.get(kImuCalibrationKey, bytes, sizeof bytes) != sizeof bytes) return;
    if (calibration_.decode(bytes)) state_ = State::kDone;
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

  /// The robot stands upright and still, torque off. The old calibration counts until there is
  /// a new one.
  void measure() {
    calibrator_.begin();
    state_ = State::kMeasuring;
  }
  /// Torque is coming on: what steers must not change under a robot that stands on it.
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
  /// Whenever there is time: hands a change to the memory, whose work() somebody else calls.
  void keep() {
    if (unkept_ == Unkept::kNothing) return;
    std::uint8_t bytes[ImuCalibration::kBytes];
    calibration_.encode(bytes);
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
  ImuCalibrator calibrator_;
  ImuCalibration calibration_;
  State state_ = State::kNone;
  Unkept unkept_ = Unkept::kNothing;
};

}  // namespace verp::app
