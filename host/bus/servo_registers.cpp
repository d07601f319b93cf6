#include "host/bus/servo_registers.hpp"

#include <utility>

namespace verp::bus::servo {

namespace at = dxl::address;

// Initial values and ranges: e-Manual, as control_table.hpp. Current registers are the X-series'
// own, Acceleration Limit the MX's.
std::vector<Register> registers_of(const ServoIdentity& identity) {
  const bool mx = identity.model < 1000;
  constexpr std::int64_t kTurn = 1044479;  // Homing Offset's range
  constexpr std::int64_t kGain = 16383;
  std::vector<Register> registers = {
      {at::kModelNumber, 2, false, identity.model},
      {at::kModelInformation, 4, false, 0},
      {at::kFirmwareVersion, 1, false, 45},  // first with Fast Sync Read
      {at::kId, 1, true, identity.id, 0, dxl::kMaxId},
      {at::kBaudRate, 1, true, dxl::baud_rate_code(identity.baud), 0, 7},
      {at::kReturnDelay, 1, true, 250, 0, 254},
      {at::kDriveMode, 1, true, 0, 0, mx ? 5 : 13},
      {at::kOperatingMode, 1, true, dxl::kPositionMode, 0, 16},
      {at::kSecondaryId, 1, true, 255, 0, 255},
      {at::kProtocolVersion, 1, true, 2, 1, 2},
      {at::kHomingOffset, 4, true, 0, -kTurn, kTurn},
      {at::kMovingThreshold, 4, true, 10, 0, 1023},
      {at::kTemperatureLimit, 1, true, 80, 0, 100},
      {at::kMaxVoltageLimit, 2, true, 160, 95, 160},
      {at::kMinVoltageLimit, 2, true, 95, 95, 160},
      {at::kPwmLimit, 2, true, dxl::kFullPwm, 0, dxl::kFullPwm},
      {at::kCurrentLimit, 2, true, 1193, 0, 1193},
      {at::kAccelerationLimit, 4, true, 32767, 0, 32767},
      {at::kVelocityLimit, 4, true, mx ? 380 : 330, 0, 1023},
      {at::kMaxPositionLimit, 4, true, 4095, 0, 4095},
      {at::kMinPositionLimit, 4, true, 0, 0, 4095},
      {kStartupConfiguration, 1, true, 0, 0, 3},
      {at::kShutdown, 1, true, 52, 0, 255},
      {at::kTorqueEnable, 1, true, 0, 0, 1},
      {at::kLed, 1, true, 0, 0, 1},
      {at::kStatusReturnLevel, 1, true, 2, 0, 2},
      {at::kRegisteredInstruction, 1, false, 0},
      {at::kHardwareError, 1, false, 0},
      {at::kVelocityIGain, 2, true, 1920, 0, kGain},
      {at::kVelocityPGain, 2, true, 100, 0, kGain},
      {at::kPositionDGain, 2, true, 0, 0, kGain},
      {at::kPositionIGain, 2, true, 0, 0, kGain},
      {at::kPositionPGain, 2, true, mx ? 850 : 800, 0, kGain},
      {at::kFeedforward2Gain, 2, true, 0, 0, kGain},
      {at::kFeedforward1Gain, 2, true, 0, 0, kGain},
      {at::kBusWatchdog, 1, true, 0, 0, dxl::kBusWatchdogMost},
      {at::kGoalPwm, 2, true, dxl::kFullPwm, -dxl::kFullPwm, dxl::kFullPwm},
      {at::kGoalCurrent, 2, true, 1193, -1193, 1193},
      {at::kGoalVelocity, 4, true, 0, -1023, 1023},
      {at::kProfileAcceleration, 4, true, 0, 0, 32767},
      {at::kProfileVelocity, 4, true, 0, 0, 32767},
      {at::kGoalPosition, 4, true, 0, -kMostTurns, kMostTurns},
      {at::kRealtimeTick, 2, false, 0},
      {at::kMoving, 1, false, 0},
      {at::kMovingStatus, 1, false, 0},
      {at::kPresentPwm, 2, false, 0, -1},
      {at::kPresentCurrent, 2, false, 0, -1},
      {at::kPresentVelocity, 4, false, 0, -1},
      {at::kPresentPosition, 4, false, 0, -1},
      {at::kVelocityTrajectory, 4, false, 0, -1},
      {at::kPositionTrajectory, 4, false, 0, -1},
      {at::kPresentVoltage, 2, false, 120},
      {at::kPresentTemperature, 1, false, 25},
      {at::kBackupReady, 1, false, 0},
  };
  for (const auto& [addresses, data] : {std::pair{at::kIndirectAddress1, at::kIndirectData1},
                                        std::pair{at::kIndirectAddress29, at::kIndirectData29}}) {
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(addresses + 2 * n), 2, true, data + n,
                           dxl::kIndirectFirst, dxl::kIndirectLast});
    }
    for (std::uint16_t n = 0; n < dxl::kIndirectBlock; ++n) {
      registers.push_back({static_cast<std::uint16_t>(data + n), 1, true, 0, 0, 255});
    }
  }
  std::erase_if(registers, [mx](const Register& reg) {
    if (mx) {
      return reg.address == at::kCurrentLimit || reg.address == at::kGoalCurrent ||
             reg.address == kStartupConfiguration;
    }
    return reg.address == at::kAccelerationLimit;
  });
  return registers;
}

}  // namespace verp::bus::servo
