#pragma once
#include <cstdint>

#include "boards/stm32/f4_ports.hpp"

/// Olimex STM32-H405: STM32F405RGT6 (Cortex-M4F). QEMU's netduinoplus2 has the same chip. Pins and
/// alternate functions: DS8626, pin definitions and alternate function mapping; DMA streams:
/// RM0090 10.3.3; LED: the board's user manual. README.md has the wiring.
namespace verp::board {

namespace stm32 = hal::stm32;

inline constexpr const char* kName = "olimex_h405";
inline constexpr const char* kCore = "Cortex-M4F";
inline constexpr int kReplayBlock = 64;
/// For fault tests: an address without memory (no external memory).
inline constexpr std::uintptr_t kNowhere = 0x6FFFFFF0;

inline constexpr stm32::Family kFamily = stm32::Family::kF405;
using UsartKind = stm32::UsartV1;

inline constexpr stm32::ClockPlan kClockPlan = {
    .crystal_hz = 8'000'000, .external = false, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
static_assert(stm32::is_possible(kClockPlan, kFamily));
/// QEMU 7.2: SysTick at 168 MHz, timers at 1 GHz.
inline constexpr stm32::Clocks kWithoutClockController = {.source = stm32::ClockSource::kAbsent,
                                                          .sysclk_hz = 168'000'000,
                                                          .apb1_hz = 42'000'000,
                                                          .apb2_hz = 84'000'000,
                                                          .apb1_timer_hz = 1'000'000'000};

/// On port B: the USB connector also uses PA9 and PA10.
inline constexpr SerialPort kServoPort = f4_servo_port({'B', 6}, {'B', 7});
inline constexpr CanPort kCanPort = kF4CanPort;
inline constexpr SerialPort kOperatorPort = kF4OperatorPort;

inline constexpr Pin kLed = {'C', 12};
inline constexpr Pin kServoPower = {};  ///< not switched on this board
inline constexpr ImuPort kImu = {};
inline constexpr ImuPort kSensorImu = kF4SensorImu;
inline constexpr FootPort kFootPort = kF4FootPort;
inline constexpr stm32::AnalogWiring kBattery = {};
inline constexpr Pin kEmergencyStop = {};
inline constexpr Button kButtons[2] = {};
inline constexpr Pin kBuzzer = {};

}  // namespace verp::board
