#pragma once
#include <concepts>
#include <cstdint>

/// Imu: a gyroscope and accelerometer on the controller's own board.
///
/// Promises of a backend:
///  - read(sample): the mean of all complete samples that the chip took since the last read, or
///    says why there is none; waits at most kImuMaxWait_us, whatever the chip does. Only kFresh
///    changes the sample. So no turn falls between two reads: what is read, each times the time
///    since the one before, adds up to it, within the chip's rate against the reads'.
///  - Reads at most kImuMostPause_us apart miss nothing. After a longer pause the backend may drop
///    what came meanwhile, and is kStale once.
///  - All six counts are of the same samples, in the chip's own axes and resolution, saturated at
///    the int16 limits and rounded to the nearest; scale, range and mounting are the robot's
///    Params. No sample is given twice: a read that finds no new one is kStale. time_us is when the
///    newest was fetched, by the board's TickSource, and rises from read to read.
///  - After kFault (a silent, stuck or foreign chip) the backend tries again by itself in later
///    reads, none of which waits longer for it. faults() counts them, modulo 2^32.
///  - Bias and calibration are not its business. No call allocates or throws.
/// Implementations: hal/fake/scripted_imu.hpp, the SPI chips of hal/chip. User:
/// firmware/app/app.hpp, for a robot whose Params name no IMU on the servo bus.
namespace verp::hal {

inline constexpr std::uint32_t kImuMaxWait_us = 500;
inline constexpr std::uint32_t kImuMostPause_us = 22'000;  ///< the longest period, and 10 % of it

struct ImuSample {
  std::int16_t gyro_count[3] = {};
  std::int16_t accel_count[3] = {};
  std::uint64_t time_us = 0;
};

/// Sums samples up for a backend.
class ImuMean {
 public:
  void add(const ImuSample& sample) {
    for (int axis = 0; axis < 3; ++axis) {
      gyro_[axis] += sample.gyro_count[axis];
      accel_[axis] += sample.accel_count[axis];
    }
    ++count_;
  }
  /// The six counts of `sample` become the mean since the last take(). False: of none.
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
  /// Halves go away from zero: a bias to one side would add up to a turn.
  std::int16_t nearest(std::int32_t sum) const {
    const std::int32_t half = sum < 0 ? -(count_ / 2) : count_ / 2;
    return static_cast<std::int16_t>((sum + half) / count_);
  }

  std::int32_t gyro_[3] = {}, accel_[3] = {};
  std::int32_t count_ = 0;
};

enum class ImuStatus : std::uint8_t { kFresh = 0, kStale = 1, kFault = 2 };

template <class Chip>
concept Imu = requires(Chip& chip, const Chip& seen, ImuSample& sample) {
  { chip.read(sample) } -> std::same_as<ImuStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
