#pragma once
#include <concepts>
#include <cstdint>

/// Imu: a gyroscope and accelerometer on the controller's own board.
///
/// Promises of a backend:
///  - read(sample): the newest complete sample, or says why there is none; waits at most
///    kImuMaxWait_us, whatever the chip does. Only kFresh changes the sample.
///  - All six counts are of one instant, in the chip's own axes and resolution, saturated at the
///    int16 limits; scale, range and mounting are the robot's Params. No sample is given twice:
///    the second read of it is kStale. time_us is when it was taken, by the board's TickSource,
///    and rises from sample to sample.
///  - After kFault (a silent, stuck or foreign chip) the backend tries again by itself in later
///    reads, none of which waits longer for it. faults() counts them, modulo 2^32.
///  - Bias and calibration are not its business. No call allocates or throws.
/// Implementations: hal/fake/scripted_imu.hpp, the SPI chips of hal/chip. User:
/// firmware/app/app.hpp, for a robot whose Params name no IMU on the servo bus.
namespace verp::hal {

inline constexpr std::uint32_t kImuMaxWait_us = 500;  ///< 14 bytes at 400 kbit/s of I2C take 340

struct ImuSample {
  std::int16_t gyro_count[3] = {};
  std::int16_t accel_count[3] = {};
  std::uint64_t time_us = 0;
};

enum class ImuStatus : std::uint8_t { kFresh = 0, kStale = 1, kFault = 2 };

template <class Chip>
concept Imu = requires(Chip& chip, const Chip& seen, ImuSample& sample) {
  { chip.read(sample) } -> std::same_as<ImuStatus>;
  { seen.faults() } -> std::same_as<std::uint32_t>;
};

}  // namespace verp::hal
