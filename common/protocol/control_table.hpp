#pragma once
#include <cstdint>

/// Registers of servos and of our sensor devices on the same bus. Servos: ROBOTIS e-Manual; which
/// model has which, and with what limits, stands in servo_models.hpp. Size in bytes after each
/// address; R: read only. EEPROM is writable only while Torque Enable is 0.
namespace verp::dxl {

inline constexpr std::uint16_t kModelXm430W210 = 1030;  ///< e-Manual, Model Number (0)
inline constexpr std::uint16_t kModelXm430W350 = 1020;  ///< likewise
inline constexpr std::uint16_t kModelMx28 = 30;         ///< likewise
inline constexpr std::uint16_t kModelImu = 0x7601;  ///< ours; the vendor's numbers end below 0x4000
inline constexpr std::uint16_t kModelFoot = 0x7602;  ///< ours

namespace address {
// EEPROM
inline constexpr std::uint16_t kModelNumber = 0;         // 2, R
inline constexpr std::uint16_t kModelInformation = 2;    // 4, R
inline constexpr std::uint16_t kFirmwareVersion = 6;     // 1, R
inline constexpr std::uint16_t kId = 7;                  // 1
inline constexpr std::uint16_t kBaudRate = 8;            // 1, see baud_rate_code
inline constexpr std::uint16_t kReturnDelay = 9;         // 1, units of 2 us, 0 to 254; factory 250
inline constexpr std::uint16_t kDriveMode = 10;          // 1, see kTimeBasedProfile
inline constexpr std::uint16_t kOperatingMode = 11;      // 1
inline constexpr std::uint16_t kSecondaryId = 12;        // 1
inline constexpr std::uint16_t kProtocolVersion = 13;    // 1
inline constexpr std::uint16_t kHomingOffset = 20;       // 4
inline constexpr std::uint16_t kMovingThreshold = 24;    // 4, units of 0.229 rev/min
inline constexpr std::uint16_t kTemperatureLimit = 31;   // 1, degrees Celsius
inline constexpr std::uint16_t kMaxVoltageLimit = 32;    // 2, 0.1 V
inline constexpr std::uint16_t kMinVoltageLimit = 34;    // 2, 0.1 V
inline constexpr std::uint16_t kPwmLimit = 36;           // 2, 885 is 100 %
inline constexpr std::uint16_t kCurrentLimit = 38;       // 2
inline constexpr std::uint16_t kAccelerationLimit = 40;  // 4
inline constexpr std::uint16_t kVelocityLimit = 44;      // 4
inline constexpr std::uint16_t kMaxPositionLimit = 48;   // 4
inline constexpr std::uint16_t kMinPositionLimit = 52;   // 4
inline constexpr std::uint16_t kExternalPortMode1 = 56;  // 1; 2 and 3 follow
inline constexpr std::uint16_t kStartupConfiguration = 60;  // 1
inline constexpr std::uint16_t kPwmSlope = 62;              // 1
inline constexpr std::uint16_t kShutdown = 63;              // 1, mask over Hardware Error Status
// RAM
inline constexpr std::uint16_t kTorqueEnable = 64;           // 1
inline constexpr std::uint16_t kLed = 65;                    // 1
inline constexpr std::uint16_t kStatusReturnLevel = 68;      // 1; 0 ping, 1 ping and read, 2 all
inline constexpr std::uint16_t kRegisteredInstruction = 69;  // 1, R
inline constexpr std::uint16_t kHardwareError = 70;          // 1, R; HardwareError
inline constexpr std::uint16_t kVelocityIGain = 76;          // 2
inline constexpr std::uint16_t kVelocityPGain = 78;          // 2
inline constexpr std::uint16_t kPositionDGain = 80;          // 2
inline constexpr std::uint16_t kPositionIGain = 82;          // 2
inline constexpr std::uint16_t kPositionPGain = 84;          // 2
inline constexpr std::uint16_t kFeedforward2Gain = 88;       // 2
inline constexpr std::uint16_t kFeedforward1Gain = 90;       // 2
inline constexpr std::uint16_t kBusWatchdog = 98;            // 1, see kBusWatchdogUnit_us
inline constexpr std::uint16_t kGoalPwm = 100;               // 2
inline constexpr std::uint16_t kGoalCurrent = 102;           // 2
inline constexpr std::uint16_t kGoalVelocity = 104;          // 4
inline constexpr std::uint16_t kProfileAcceleration = 108;   // 4; ms with a time-based profile
inline constexpr std::uint16_t kProfileVelocity = 112;       // 4; ms with a time-based profile
inline constexpr std::uint16_t kGoalPosition = 116;          // 4
inline constexpr std::uint16_t kRealtimeTick = 120;          // 2, R, ms
inline constexpr std::uint16_t kMoving = 122;                // 1, R
inline constexpr std::uint16_t kMovingStatus = 123;          // 1, R
inline constexpr std::uint16_t kPresentPwm = 124;            // 2, R
inline constexpr std::uint16_t kPresentCurrent = 126;        // 2, R; or a load, 0.1 %
inline constexpr std::uint16_t kPresentVelocity = 128;       // 4, R, 0.229 rev/min
inline constexpr std::uint16_t kPresentPosition = 132;       // 4, R
inline constexpr std::uint16_t kVelocityTrajectory = 136;    // 4, R
inline constexpr std::uint16_t kPositionTrajectory = 140;    // 4, R
inline constexpr std::uint16_t kPresentVoltage = 144;        // 2, R, 0.1 V
inline constexpr std::uint16_t kPresentTemperature = 146;    // 1, R, degrees Celsius
inline constexpr std::uint16_t kBackupReady = 147;           // 1, R
inline constexpr std::uint16_t kExternalPortData1 = 152;     // 2; 2 and 3 follow
// Indirect Addresses (2 bytes each) and Data (1 byte); elsewhere in the XL330 and XC330.
inline constexpr std::uint16_t kIndirectAddress1 = 168;
inline constexpr std::uint16_t kIndirectData1 = 224;
inline constexpr std::uint16_t kIndirectAddress29 = 578;
inline constexpr std::uint16_t kIndirectData29 = 634;
}  // namespace address

inline constexpr std::uint16_t kIndirectBlock = 28;  ///< pairs in each block
inline constexpr std::uint16_t kIndirectFirst = 64;  ///< lowest address allowed there
inline constexpr std::uint8_t kFactoryId = 1;
inline constexpr std::uint32_t kFactoryBaud = 57600;

inline constexpr std::uint8_t kTimeBasedProfile = 1 << 2;  ///< bit 2 of Drive Mode
inline constexpr std::uint8_t kPositionMode = 3;           ///< Operating Mode; one turn
inline constexpr int kCountsPerTurn = 4096;                ///< positions
inline constexpr std::uint16_t kFullPwm = 885;             ///< PWM Limit of 100 %

/// After this many units with torque and no instruction packet on the bus the servo stops in place,
/// and goals are refused until 0 is written to Bus Watchdog. 0: off.
inline constexpr std::uint32_t kBusWatchdogUnit_us = 20000;
inline constexpr std::uint8_t kBusWatchdogMost = 127;
inline constexpr std::uint8_t kBusWatchdogTripped = 0xFF;  ///< -1, read after a trip

/// Bits of Hardware Error Status (70) and Shutdown (63).
enum HardwareError : std::uint8_t {
  kInputVoltageError = 1 << 0,
  kOverheatingError = 1 << 2,
  kEncoderError = 1 << 3,
  kElectricalShockError = 1 << 4,
  kOverloadError = 1 << 5,
};

/// By the value of Baud Rate (8).
inline constexpr std::uint32_t kBaudRates[] = {9600,    57600,   115200,  1000000,
                                               2000000, 3000000, 4000000, 4500000};

/// Value of Baud Rate (8); 0xFF for a rate that the servos lack.
constexpr std::uint8_t baud_rate_code(std::uint32_t baud) {
  for (std::uint8_t code = 0; code < 8; ++code) {
    if (kBaudRates[code] == baud) return code;
  }
  return 0xFF;
}

/// Twelve bytes from 136, fetched every tick by one Sync Read from the IMU, both feet and one
/// servo:
///   IMU device:  gyro x y z, accel x y z; int16 each, IMU frame;
///   foot device: front-left, front-right, back-left, back-right; uint16 each; then 4 zero bytes;
///   servo:       Velocity Trajectory, Position Trajectory, Present Input Voltage, Present
///                Temperature, Backup Ready.
/// A read may begin some bytes earlier (BusMaster::spare_bytes), which are ignored.
namespace sensor_block {
inline constexpr std::uint16_t kAddress = 136;
inline constexpr std::uint16_t kBytes = 12;
inline constexpr std::uint16_t kGyro = kAddress;       // 3 x int16
inline constexpr std::uint16_t kAccel = kAddress + 6;  // 3 x int16
inline constexpr std::uint16_t kFoot = kAddress;       // 4 x uint16
static_assert(address::kPresentVoltage >= kAddress &&
              address::kPresentTemperature < kAddress + kBytes);
}  // namespace sensor_block

}  // namespace verp::dxl
