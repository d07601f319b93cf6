#pragma once
#include <cstddef>
#include <cstdint>

/// What differs between the two motion sensors: MPU-9250 (register map RM-MPU-9250A-00) and
/// ICM-20648 (DS-000179), and how each is set up. Both: +-2000 deg/s and +-4 g by default, a low
/// pass of 40 to 50 Hz, about 500 samples a second.
namespace verp::hal::invensense {

inline constexpr std::uint8_t kReset = 0x80;   ///< PWR_MGMT_1
inline constexpr std::uint8_t kAutoClock = 1;  ///< PWR_MGMT_1: awake, the best clock there is
inline constexpr std::uint8_t kI2cOff = 0x10;  ///< USER_CTRL: else noise on SPI can look like I2C
inline constexpr std::uint8_t kDataReady = 1;  ///< interrupt status: a new sample
inline constexpr std::uint8_t kBankSelect = 0x7F;  ///< of the ICM-20648; banks count from bit 4

/// Full scale: 0 the finest, each next one twice as much.
struct Ranges {
  std::uint8_t gyro = 3;   ///< 250, 500, 1000, 2000 deg/s
  std::uint8_t accel = 1;  ///< 2, 4, 8, 16 g
};

/// One register to set. `range`: which range is added, at which bit.
struct Setting {
  enum Range : std::uint8_t { kNone, kGyro, kAccel };
  std::uint8_t bank = 0;
  std::uint8_t address = 0;
  std::uint8_t value = 0;
  Range range = kNone;
  std::uint8_t range_shift = 0;

  constexpr std::uint8_t with(const Ranges& ranges) const {
    const unsigned full_scale = range == kGyro ? ranges.gyro : range == kAccel ? ranges.accel : 0u;
    return static_cast<std::uint8_t>(value | full_scale << range_shift);
  }
};

struct Kind {
  std::uint8_t who_am_i_at, who_am_i;
  std::uint8_t power, user_control;  ///< PWR_MGMT_1, USER_CTRL
  std::uint8_t status;               ///< has kDataReady; reading clears it
  std::uint8_t accel_at, gyro_at;    ///< x, y, z, high byte first
  bool has_banks;
  std::uint32_t registers_hz;  ///< highest clock for any register
  std::uint32_t data_hz;       ///< highest clock to read status and data
  /// Tells a chip that has lost its settings: not what it is after power-up.
  std::uint8_t guard_at, guard;
  const Setting* settings;
  std::size_t setting_count;
};

/// SMPLRT_DIV, CONFIG, GYRO_CONFIG, ACCEL_CONFIG, ACCEL_CONFIG 2, INT_ENABLE (else no status).
/// 1 kHz / 2; 41 Hz.
inline constexpr Setting kMpu9250Settings[] = {{0, 0x19, 1},
                                               {0, 0x1A, 3},
                                               {0, 0x1B, 0, Setting::kGyro, 3},
                                               {0, 0x1C, 0, Setting::kAccel, 3},
                                               {0, 0x1D, 3},
                                               {0, 0x38, kDataReady}};
/// Speeds: PS-MPU-9250A-01 table 6. The status stands right before the data.
inline constexpr Kind kMpu9250 = {.who_am_i_at = 0x75,
                                  .who_am_i = 0x71,
                                  .power = 0x6B,
                                  .user_control = 0x6A,
                                  .status = 0x3A,
                                  .accel_at = 0x3B,
                                  .gyro_at = 0x43,
                                  .has_banks = false,
                                  .registers_hz = 1'000'000,
                                  .data_hz = 20'000'000,
                                  .guard_at = 0x1D,
                                  .guard = 3,
                                  .settings = kMpu9250Settings,
                                  .setting_count = 6};

/// GYRO_SMPLRT_DIV, GYRO_CONFIG_1, ODR_ALIGN_EN, ACCEL_SMPLRT_DIV_1 and _2, ACCEL_CONFIG,
/// INT_ENABLE_1 (else no status). 1125 Hz / 2; 51 and 50 Hz.
inline constexpr Setting kIcm20648Settings[] = {
    {2, 0x00, 1}, {2, 0x01, 3 << 3 | 1, Setting::kGyro, 1},  {2, 0x09, 1},         {2, 0x10, 0},
    {2, 0x11, 1}, {2, 0x14, 3 << 3 | 1, Setting::kAccel, 1}, {0, 0x11, kDataReady}};
/// Speed: DS-000179 table 4. After power-up it sleeps, which the guard sees.
inline constexpr Kind kIcm20648 = {.who_am_i_at = 0x00,
                                   .who_am_i = 0xE0,
                                   .power = 0x06,
                                   .user_control = 0x03,
                                   .status = 0x1A,
                                   .accel_at = 0x2D,
                                   .gyro_at = 0x33,
                                   .has_banks = true,
                                   .registers_hz = 7'000'000,
                                   .data_hz = 7'000'000,
                                   .guard_at = 0x06,
                                   .guard = kAutoClock,
                                   .settings = kIcm20648Settings,
                                   .setting_count = 7};

}  // namespace verp::hal::invensense
