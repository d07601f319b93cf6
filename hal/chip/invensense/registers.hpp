#pragma once
#include <cstddef>
#include <cstdint>

/// Registers and set-up of MPU-9250 (register map RM-MPU-9250A-00) and ICM-20648 (DS-000179). By
/// default: +-2000 deg/s, +-4 g, low pass of 20 to 24 Hz, about 500 samples a second. A FIFO sample
/// is twelve bytes, high byte first: acceleration x, y, z, then rates x, y, z. One divider for
/// both, so that a sample always has both.
namespace verp::hal::invensense {

inline constexpr std::uint8_t kReset = 0x80;       ///< PWR_MGMT_1
inline constexpr std::uint8_t kAutoClock = 1;      ///< PWR_MGMT_1: awake, best clock
inline constexpr std::uint8_t kI2cOff = 0x10;      ///< USER_CTRL: else SPI noise can look like I2C
inline constexpr std::uint8_t kFifoOn = 0x40;      ///< USER_CTRL
inline constexpr std::uint8_t kBankSelect = 0x7F;  ///< ICM-20648; bank from bit 4

/// 0 is the finest; each step doubles.
struct Ranges {
  std::uint8_t gyro = 3;   ///< 250, 500, 1000, 2000 deg/s
  std::uint8_t accel = 1;  ///< 2, 4, 8, 16 g
};

/// One register to write. `range` and `range_shift`: the range to add, and its bit.
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
  std::uint8_t port;                 ///< USER_CTRL: kI2cOff behind SPI
  std::uint8_t fifo_size_at;         ///< bytes, high byte first
  std::uint8_t fifo_at;              ///< each read returns the next byte
  Setting empty_fifo[2];             ///< written in turn; bank 0
  bool has_banks;
  std::uint32_t registers_hz;  ///< highest clock for any register
  std::uint32_t data_hz;       ///< highest clock for FIFO and size
  /// Shows whether the chip kept its settings; differs from its power-up value.
  std::uint8_t guard_at, guard;
  const Setting* settings;
  std::size_t setting_count;
};

/// SMPLRT_DIV, CONFIG, GYRO_CONFIG, ACCEL_CONFIG, ACCEL_CONFIG 2, FIFO_EN.
/// 1 kHz / 2; 20 and 21.2 Hz.
inline constexpr Setting kMpu9250Settings[] = {
    {0, 0x19, 1}, {0, 0x1A, 4},   {0, 0x1B, 0, Setting::kGyro, 3}, {0, 0x1C, 0, Setting::kAccel, 3},
    {0, 0x1D, 4}, {0, 0x23, 0x78}};
/// Speeds: PS-MPU-9250A-01 table 6; for the FIFO, the value of public drivers. FIFO_RST clears
/// itself; older chips need FIFO_EN off meanwhile.
inline constexpr Kind kMpu9250 = {
    .who_am_i_at = 0x75,
    .who_am_i = 0x71,
    .power = 0x6B,
    .user_control = 0x6A,
    .port = kI2cOff,
    .fifo_size_at = 0x72,
    .fifo_at = 0x74,
    .empty_fifo = {{0, 0x6A, kI2cOff | 0x04}, {0, 0x6A, kI2cOff | kFifoOn}},
    .has_banks = false,
    .registers_hz = 1'000'000,
    .data_hz = 10'000'000,
    .guard_at = 0x1D,
    .guard = 4,
    .settings = kMpu9250Settings,
    .setting_count = 6};

/// GYRO_SMPLRT_DIV, GYRO_CONFIG_1, ODR_ALIGN_EN, ACCEL_SMPLRT_DIV_1 and _2, ACCEL_CONFIG,
/// USER_CTRL, FIFO_EN_2. 1125 Hz / 2; 23.9 Hz.
inline constexpr Setting kIcm20648Settings[] = {{2, 0x00, 1},
                                                {2, 0x01, 4 << 3 | 1, Setting::kGyro, 1},
                                                {2, 0x09, 1},
                                                {2, 0x10, 0},
                                                {2, 0x11, 1},
                                                {2, 0x14, 4 << 3 | 1, Setting::kAccel, 1},
                                                {0, 0x03, kI2cOff | kFifoOn},
                                                {0, 0x67, 0x1E}};
/// Speed: DS-000179 table 4. FIFO_RST holds the FIFO empty until it is cleared. After power-up the
/// chip sleeps; the guard shows it.
inline constexpr Kind kIcm20648 = {.who_am_i_at = 0x00,
                                   .who_am_i = 0xE0,
                                   .power = 0x06,
                                   .user_control = 0x03,
                                   .port = kI2cOff,
                                   .fifo_size_at = 0x70,
                                   .fifo_at = 0x72,
                                   .empty_fifo = {{0, 0x68, 0x1F}, {0, 0x68, 0}},
                                   .has_banks = true,
                                   .registers_hz = 7'000'000,
                                   .data_hz = 7'000'000,
                                   .guard_at = 0x06,
                                   .guard = kAutoClock,
                                   .settings = kIcm20648Settings,
                                   .setting_count = 8};

/// SMPLRT_DIV, CONFIG, GYRO_CONFIG, ACCEL_CONFIG, FIFO_EN. 1 kHz / 2; 20 and 21 Hz.
inline constexpr Setting kMpu6050Settings[] = {{0, 0x19, 1},
                                               {0, 0x1A, 4},
                                               {0, 0x1B, 0, Setting::kGyro, 3},
                                               {0, 0x1C, 0, Setting::kAccel, 3},
                                               {0, 0x23, 0x78}};
/// RM-MPU-6000A-00. Only on I2C, so the speeds have no meaning.
inline constexpr Kind kMpu6050 = {.who_am_i_at = 0x75,
                                  .who_am_i = 0x68,
                                  .power = 0x6B,
                                  .user_control = 0x6A,
                                  .port = 0,
                                  .fifo_size_at = 0x72,
                                  .fifo_at = 0x74,
                                  .empty_fifo = {{0, 0x6A, 0x04}, {0, 0x6A, kFifoOn}},
                                  .has_banks = false,
                                  .registers_hz = 400'000,
                                  .data_hz = 400'000,
                                  .guard_at = 0x1A,
                                  .guard = 4,
                                  .settings = kMpu6050Settings,
                                  .setting_count = 5};

}  // namespace verp::hal::invensense
