#pragma once
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"

/// Memory table of Feetech's magnetic-encoder STS servos, and of our sensor devices on their bus.
/// Sources: [1] Feetech's memory table of the ST3215, as printed in the crate st3215 (build.rs);
/// [2] huggingface/lerobot, src/lerobot/motors/feetech/tables.py, which cites Feetech's manual of
/// SMS and STS servos; [3] Feetech, "STS Servo, Memory Table Analysis" (wiki.juxitech.com). Where
/// no number stands they agree. Size in bytes after each address; R: read only. EEPROM ends
/// before 40.
namespace verp::feetech {

namespace address {
inline constexpr std::uint8_t kFirmwareMajor = 0;       // 1, R
inline constexpr std::uint8_t kFirmwareMinor = 1;       // 1, R
inline constexpr std::uint8_t kModelNumber = 3;         // 2, R [2]; "servo version" in [1]
inline constexpr std::uint8_t kId = 5;                  // 1
inline constexpr std::uint8_t kBaudRate = 6;            // 1, see kBaudRates
inline constexpr std::uint8_t kReturnDelay = 7;         // 1, units of 2 us; reserved in [3]
inline constexpr std::uint8_t kStatusLevel = 8;         // 1; 0: only Ping and Read are answered
inline constexpr std::uint8_t kMinPosition = 9;         // 2
inline constexpr std::uint8_t kMaxPosition = 11;        // 2
inline constexpr std::uint8_t kMaxTemperature = 13;     // 1, degrees Celsius
inline constexpr std::uint8_t kMaxVoltage = 14;         // 1, 0.1 V
inline constexpr std::uint8_t kMinVoltage = 15;         // 1, 0.1 V
inline constexpr std::uint8_t kMaxTorque = 16;          // 2, 0.1 %; power-on value of kTorqueLimit
inline constexpr std::uint8_t kPhase = 18;              // 1, bits: see kWholeAngle
inline constexpr std::uint8_t kUnloading = 19;          // 1, mask over kStatus
inline constexpr std::uint8_t kAlarmLed = 20;           // 1, likewise
inline constexpr std::uint8_t kPGain = 21;              // 1
inline constexpr std::uint8_t kDGain = 22;              // 1
inline constexpr std::uint8_t kIGain = 23;              // 1
inline constexpr std::uint8_t kLeastForce = 24;         // 2, 0.1 %
inline constexpr std::uint8_t kDeadZoneCw = 26;         // 1, counts
inline constexpr std::uint8_t kDeadZoneCcw = 27;        // 1, counts
inline constexpr std::uint8_t kProtectionCurrent = 28;  // 2, 6.5 mA
inline constexpr std::uint8_t kResolution = 30;         // 1
inline constexpr std::uint8_t kOffset = 31;             // 2, sign in bit 11
inline constexpr std::uint8_t kMode = 33;               // 1; 0: position
inline constexpr std::uint8_t kProtectiveTorque = 34;   // 1, %
inline constexpr std::uint8_t kProtectionTime = 35;     // 1, 10 ms
inline constexpr std::uint8_t kOverloadTorque = 36;     // 1, %
inline constexpr std::uint8_t kSpeedP = 37;             // 1
inline constexpr std::uint8_t kOverCurrentTime = 38;    // 1, 10 ms
inline constexpr std::uint8_t kSpeedI = 39;             // 1
// RAM
inline constexpr std::uint8_t kTorqueEnable = 40;        // 1; kMakeMiddle makes this the middle
inline constexpr std::uint8_t kAcceleration = 41;        // 1, 100 counts/s^2; 0: at once
inline constexpr std::uint8_t kGoalPosition = 42;        // 2, sign in bit 15
inline constexpr std::uint8_t kGoalTime = 44;            // 2
inline constexpr std::uint8_t kGoalSpeed = 46;           // 2, counts/s, sign in bit 15; 0: the most
inline constexpr std::uint8_t kTorqueLimit = 48;         // 2, 0.1 %
inline constexpr std::uint8_t kLock = 55;                // 1; 1: EEPROM writes are not kept
inline constexpr std::uint8_t kPresentPosition = 56;     // 2, R, sign in bit 15
inline constexpr std::uint8_t kPresentSpeed = 58;        // 2, R, counts/s, sign in bit 15
inline constexpr std::uint8_t kPresentLoad = 60;         // 2, R, 0.1 % of duty, sign in bit 10
inline constexpr std::uint8_t kPresentVoltage = 62;      // 1, R, 0.1 V
inline constexpr std::uint8_t kPresentTemperature = 63;  // 1, R, degrees Celsius
inline constexpr std::uint8_t kRegistered = 64;          // 1, R
inline constexpr std::uint8_t kStatus = 65;              // 1, R, ServoStatus
inline constexpr std::uint8_t kMoving = 66;              // 1, R
inline constexpr std::uint8_t kPresentCurrent = 69;  // 2, R, 6.5 mA; sign in bit 15: an assumption
}  // namespace address

inline constexpr unsigned kLoadSign = 10, kOffsetSign = 11, kSign = 15;  // [2]
/// The bit of a signed register's sign; 0: none.
constexpr unsigned sign_bit(std::uint8_t at) {
  switch (at) {
    case address::kPresentLoad:
      return kLoadSign;
    case address::kOffset:
      return kOffsetSign;
    case address::kGoalPosition:
    case address::kGoalSpeed:
    case address::kPresentPosition:
    case address::kPresentSpeed:
    case address::kPresentCurrent:
      return kSign;
    default:
      return 0;
  }
}

inline constexpr std::uint16_t kModelSts3215 = 777;  // [2]; the 7.4 V and 12 V variants share it
inline constexpr std::uint16_t kModelImu = 0x7601;   ///< ours, as on Dynamixel's bus
inline constexpr std::uint16_t kModelFoot = 0x7602;  ///< ours

inline constexpr int kCountsPerTurn = 4096;
inline constexpr int kMostOffset = 2047;             ///< [1]
inline constexpr std::uint16_t kFullTorque = 1000;   ///< Max Torque of 100 %
inline constexpr std::uint8_t kMostGain = 254;       ///< [1]
inline constexpr std::uint8_t kMakeMiddle = 128;     ///< [1], Torque Enable
inline constexpr std::uint8_t kWholeAngle = 1 << 4;  ///< [3], Phase: positions count turns
/// Duty for one count of error and one unit of P. Rhoban/bam, bam/feetech/actuator.py: 0.166 per
/// radian, by an oscilloscope. Units of I and D are published nowhere.
inline constexpr float kDutyPerCount = 0.166F * 2 * 3.14159265F / kCountsPerTurn;

/// Bits of Status (65) and of each answer's status byte [1]. Bit 4 is "angle" there, unused in [3],
/// and "torque is on" in the package feetech of hex.pm: it is ignored.
enum ServoStatus : std::uint8_t {
  kVoltageStatus = 1 << 0,
  kEncoderStatus = 1 << 1,
  kTemperatureStatus = 1 << 2,
  kCurrentStatus = 1 << 3,
  kOverloadStatus = 1 << 5,
};
inline constexpr std::uint8_t kStatusBits =
    kVoltageStatus | kEncoderStatus | kTemperatureStatus | kCurrentStatus | kOverloadStatus;

/// By the value of Baud Rate (6) [1]. [2] has other rates for 5 to 7, so no robot may use these.
inline constexpr std::uint32_t kBaudRates[] = {1000000, 500000, 250000, 128000, 115200};

/// 0xFF for a rate that the servos lack.
constexpr std::uint8_t baud_rate_code(std::uint32_t baud) {
  for (std::uint8_t code = 0; code < 5; ++code) {
    if (kBaudRates[code] == baud) return code;
  }
  return 0xFF;
}

/// Fourteen bytes from 60, fetched every tick by one Sync Read from the IMU, both feet and one
/// servo: IMU gyro x y z, accel x y z (int16 each); foot front-left, front-right, back-left,
/// back-right (uint16 each), then zeros; both end in a CRC-16 over id and data, because the
/// packet's checksum is weak. Servo: Present Load and what follows it. A read may begin some bytes
/// earlier (RequestMaster::spare_bytes), which are ignored.
namespace sensor_block {
inline constexpr std::uint8_t kAddress = 60;
inline constexpr std::uint8_t kBytes = 14;
inline constexpr std::uint8_t kCheckAt = 12;
static_assert(address::kPresentVoltage >= kAddress && address::kStatus < kAddress + kBytes);

inline std::uint16_t check_of(std::uint8_t id, const std::uint8_t* data) {
  return dxl::crc16(data, kCheckAt, dxl::crc16(&id, 1));
}
}  // namespace sensor_block

}  // namespace verp::feetech
