#pragma once
#include <cstdint>

#include "boards/stm32/wiring.hpp"

/// Olimex STM32-H405: STM32F405RGT6 (Cortex-M4F). QEMU's netduinoplus2 has the same chip.
/// Pins and alternate functions: DS8626, pin definitions and alternate function mapping; DMA
/// streams: RM0090 10.3.3; LED: the board's user manual. README.md has the wiring.
namespace verp::board {

namespace stm32 = hal::stm32;

inline constexpr const char* kName = "olimex_h405";
inline constexpr const char* kCore = "Cortex-M4F";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 64;
/// No memory is here, for tests of faults: no external memory.
inline constexpr std::uintptr_t kNowhere = 0x6FFFFFF0;

inline constexpr stm32::Family kFamily = stm32::Family::kF405;
using UsartKind = stm32::UsartV1;

inline constexpr stm32::ClockPlan kClockPlan = {
    .crystal_hz = 8'000'000, .external = false, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
static_assert(stm32::is_possible(kClockPlan, kFamily));
/// QEMU 7.2 has no clock controller; its SysTick runs at 168 MHz, its timers at 1 GHz.
inline constexpr stm32::Clocks kWithoutClockController = {.source = stm32::ClockSource::kAbsent,
                                                          .sysclk_hz = 168'000'000,
                                                          .apb1_hz = 42'000'000,
                                                          .apb2_hz = 84'000'000,
                                                          .apb1_timer_hz = 1'000'000'000};

/// USART1 on port B: PA9 and PA10 are also the USB connector's.
inline constexpr SerialPort kServoPort = {.wiring = {.base = stm32::base::kUsart1,
                                                     .dma_base = stm32::base::kDma2,
                                                     .dma_stream = 2,
                                                     .dma_channel = 4,
                                                     .direction = {'B', 5}},
                                          .transmit = {'B', 6},
                                          .receive = {'B', 7},
                                          .function = 7,
                                          .gate = {stm32::rcc::kApb2enr, stm32::rcc::kApb2Usart1},
                                          .dma_gate = {stm32::rcc::kAhb1enr, stm32::rcc::kAhb1Dma2},
                                          .on_apb2 = true,
                                          .interrupt = stm32::irq::kUsart1,
                                          .dma_interrupt = stm32::irq::dma2(2)};
/// They go to a CAN transceiver.
inline constexpr CanPort kCanPort = {.base = stm32::base::kCan1,
                                     .filters = {},
                                     .clocks = stm32::rcc::kApb1Can1,
                                     .transmit = {'B', 9},
                                     .receive = {'B', 8},
                                     .function = 9,
                                     .first_interrupt = stm32::irq::kCan1Tx};
inline constexpr SerialPort kOperatorPort = {
    .wiring = {.base = stm32::base::kUsart2,
               .dma_base = stm32::base::kDma1,
               .dma_stream = 5,
               .dma_channel = 4,
               .direction = {}},
    .transmit = {'A', 2},
    .receive = {'A', 3},
    .function = 7,
    .gate = {stm32::rcc::kApb1enr, stm32::rcc::kApb1Usart2},
    .dma_gate = {stm32::rcc::kAhb1enr, stm32::rcc::kAhb1Dma1},
    .on_apb2 = false,
    .interrupt = stm32::irq::kUsart2,
    .dma_interrupt = stm32::irq::dma1(5),
    .baud = 1'000'000};

inline constexpr Pin kLed = {'C', 12};
inline constexpr Pin kServoPower = {};  ///< the board switches none
inline constexpr ImuPort kImu = {};
inline constexpr stm32::AnalogWiring kBattery = {};
inline constexpr Pin kEmergencyStop = {};
inline constexpr Button kButtons[2] = {};
inline constexpr Pin kBuzzer = {};

}  // namespace verp::board
