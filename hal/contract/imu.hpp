#pragma once
#include <concepts>
#include <cstdint>

/// Imu: a gyroscope and accelerometer on the controller's own board.
///
/// A backend promises:
///  - read(sample): the mean of all complete samples since the last read, or why there is none.
///    Waits at most kImuMaxWait_us. Only kFresh and kAssumed change the sample. The mean keeps
///    rotation: rates times intervals sum to the full turn, up to the mismatch of chip rate and
///    read rate.
///  - Reads at most kImuMostPause_us apart miss nothing. After a longer pause the backend may drop
///    samples and return kStale once.
///  - All six counts come from the same samples, in the chip's axes and resolution, saturated at
///    the int16 limits and rounded to nearest. Params hold scale, range and mounting. A read
///    without a new sample is kStale. time_us: when the newest was fetched, by the board's
///    TickSource; it rises.
///  - After kFault (silent, stuck or unknown chip) later reads retry. faults() counts, modulo 2^32.
///  - The backend applies no calibration. No call allocates or throws.
namespace verp::hal {

inline constexpr std::uint32_t kImuMaxWait_us = 500;
inline constexpr std::uint32_t kImuMostPause_us = 22'000;  ///< longest period plus 10 %

struct ImuSample {
  std::int16_t gyro_count[3] = {};
  std::int16_t accel_count[3] = {};
  std::uint64_t time_us = 0;
};

/// Averages samples for a backend.
class ImuMean {
 public:
  void add(const ImuSample& sample) {
    for (int axis = 0; axis < 3; ++axis) {
      gyro_[axis] += sample.gyro_count[axis];
      accel_[axis] += sample.accel_count[axis];
    }
    ++count_;
  }
  void add(const ImuMean& others) {
    for (int axis = 0; axis < 3; ++axis) {
      gyro_[axis] += others.gyro_[axis];
      accel_[axis] += others.accel_[axis];
    }
    count_ += others.count_;
  }
  std::int32_t count() const { return count_; }
  /// Takes the mean since the last take(). False: there were no samples.
  bool take(ImuSample& sample) {
    if (count_ == 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
      sample.gyro_count[axis] = nearest(gyro_[axis]);
      sample.accel_count[axis] = nearest(accel_[axis]);
    }
    *this = {};
    return true;
  }

 private:
  /// Rounds halves away from zero: rounding one way would add up to a rotation.
  std::int16_t nearest(std::int32_t sum) const {
    const std::int32_t half = sum < 0 ? -(count_ / 2) : count_ / 2;
    return static_cast<std::int16_t>((sum + half) / count_);
  }

  std::int32_t gyro_[3] = {}, accel_[3] = {};
  std::int32_t count_ = 0;
};

enum class ImuStatus : std::uint8_t {
  kFresh = 0,
  kStale = 1,
  kFault = 2,
  kAssumed = 3,  ///< there is no chip: the sample is that of an upright body
};

template <class Chip>
concept Imu = requires(Chip& chip, const Chip& seen, ImuSample& sample) {
  { chip.read(sample) } -> std::same_as<ImuStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
