#pragma once
#include "boards/stm32/f4_ports.hpp"

/// ST Nucleo-F446RE: STM32F446RET6 (Cortex-M4F). Pins and alternate functions: DS10693, pin
/// definitions and alternate function mapping; DMA streams: RM0390 9.3.4; clock, LED and virtual
/// COM port: UM1724. README.md has the wiring.
namespace verp::board {

namespace stm32 = hal::stm32;

inline constexpr const char* kName = "nucleo_f446re";
inline constexpr const char* kCore = "Cortex-M4F";
inline constexpr int kReplayBlock = 64;

inline constexpr stm32::Family kFamily = stm32::Family::kF446;
using UsartKind = stm32::UsartV1;

inline constexpr stm32::ClockPlan kClockPlan = {
    .crystal_hz = 8'000'000, .external = true, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
static_assert(stm32::is_possible(kClockPlan, kFamily));
/// On another chip the timer refuses to open, and nothing runs.
inline constexpr stm32::Clocks kWithoutClockController = {};

/// Arduino pins D8, D2 and D4.
inline constexpr SerialPort kServoPort = f4_servo_port({'A', 9}, {'A', 10});
/// Arduino pins D14 and D15.
inline constexpr CanPort kCanPort = kF4CanPort;
inline constexpr SerialPort kOperatorPort = kF4OperatorPort;

inline constexpr Pin kLed = {'A', 5};
inline constexpr Pin kServoPower = {};  ///< not switched on this board
inline constexpr ImuPort kImu = {};
inline constexpr ImuPort kSensorImu = kF4SensorImu;
inline constexpr FootPort kFootPort = kF4FootPort;
inline constexpr stm32::AnalogWiring kBattery = {};
inline constexpr Pin kEmergencyStop = {};
inline constexpr Button kButtons[2] = {};
inline constexpr Pin kBuzzer = {};

}  // namespace verp::board
