#pragma once
#include "boards/stm32/wiring.hpp"

/// ST Nucleo-F446RE: STM32F446RET6 (Cortex-M4F).
/// Pins and alternate functions: DS10693, pin definitions and alternate function mapping; DMA
/// streams: RM0390 9.3.4; clock, LED and virtual COM port: UM1724. README.md has the wiring.
namespace verp::board {

namespace stm32 = hal::stm32;

inline constexpr const char* kName = "nucleo_f446re";
inline constexpr const char* kCore = "Cortex-M4F";
/// Ticks that a replay moves at once.
inline constexpr int kReplayBlock = 64;

inline constexpr stm32::Family kFamily = stm32::Family::kF446;
using UsartKind = stm32::UsartV1;

inline constexpr stm32::ClockPlan kClockPlan = {
    .crystal_hz = 8'000'000, .external = true, .vco_hz = 336'000'000, .sysclk_hz = 168'000'000};
static_assert(stm32::is_possible(kClockPlan, kFamily));
/// A chip without a clock controller is no F446: the timer is refused, and nothing runs.
inline constexpr stm32::Clocks kWithoutClockController = {};

/// Arduino pins D8, D2 and D4.
inline constexpr SerialPort kServoPort = {.wiring = {.base = stm32::base::kUsart1,
                                                     .dma_base = stm32::base::kDma2,
                                                     .dma_stream = 2,
                                                     .dma_channel = 4,
                                                     .direction = {'B', 5}},
                                          .transmit = {'A', 9},
                                          .receive = {'A', 10},
                                          .function = 7,
                                          .gate = {stm32::rcc::kApb2enr, stm32::rcc::kApb2Usart1},
                                          .dma_gate = {stm32::rcc::kAhb1enr, stm32::rcc::kAhb1Dma2},
                                          .on_apb2 = true,
                                          .interrupt = stm32::irq::kUsart1,
                                          .dma_interrupt = stm32::irq::dma2(2)};
/// Arduino pins D14 and D15. They go to a CAN transceiver.
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

inline constexpr Pin kLed = {'A', 5};
inline constexpr Pin kServoPower = {};  ///< the board switches none
inline constexpr ImuPort kImu = {};
inline constexpr stm32::AnalogWiring kBattery = {};
inline constexpr Pin kEmergencyStop = {};
inline constexpr Button kButtons[2] = {};
inline constexpr Pin kBuzzer = {};

}  // namespace verp::board
