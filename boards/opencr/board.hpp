#pragma once
#include "boards/stm32/wiring.hpp"

/// ROBOTIS OpenCR 1.0: STM32F746ZGT6 (Cortex-M7, single precision). Pins: ROBOTIS-GIT/OpenCR,
/// arduino/opencr_arduino/opencr/variants/OpenCR (variant.cpp, drv_uart.c, drv_dxl.c, drv_can.c,
/// hw/usb_cdc); alternate functions and DMA streams: its drv_uart.c. README.md has the wiring.
namespace verp::board {

namespace stm32 = hal::stm32;

inline constexpr const char* kName = "opencr";
inline constexpr const char* kCore = "Cortex-M7";
inline constexpr int kReplayBlock = 64;

inline constexpr stm32::Family kFamily = stm32::Family::kF746;
using UsartKind = stm32::UsartV2;

inline constexpr stm32::ClockPlan kClockPlan = {
    .crystal_hz = 25'000'000, .external = false, .vco_hz = 432'000'000, .sysclk_hz = 216'000'000};
static_assert(stm32::is_possible(kClockPlan, kFamily));
/// On another chip the timer refuses to open, and nothing runs.
inline constexpr stm32::Clocks kWithoutClockController = {};

/// The DYNAMIXEL connectors, TTL and RS-485: one direction pin.
inline constexpr SerialPort kServoPort = {.wiring = {.base = stm32::base::kUsart3,
                                                     .dma_base = stm32::base::kDma1,
                                                     .dma_stream = 1,
                                                     .dma_channel = 4,
                                                     .direction = {'C', 9}},
                                          .transmit = {'C', 10},
                                          .receive = {'C', 11},
                                          .function = 7,
                                          .gate = {stm32::rcc::kApb1enr, stm32::rcc::kApb1Usart3},
                                          .dma_gate = {stm32::rcc::kAhb1enr, stm32::rcc::kAhb1Dma1},
                                          .on_apb2 = false,
                                          .interrupt = stm32::irq::kUsart3,
                                          .dma_interrupt = stm32::irq::dma1(1)};
/// The CAN connector: drv_can.c, its second channel.
inline constexpr CanPort kCanPort = {.base = stm32::base::kCan2,
                                     .filters = stm32::kCan2Filters,
                                     .clocks = stm32::rcc::kApb1Can1 | stm32::rcc::kApb1Can2,
                                     .transmit = {'B', 13},
                                     .receive = {'B', 12},
                                     .function = 9,
                                     .first_interrupt = stm32::irq::kCan2Tx};
/// VBUS is not sensed: usb_cdc/usbd_conf.c.
inline constexpr UsbPort kOperatorPort = {.minus = {'A', 11},
                                          .plus = {'A', 12},
                                          .function = 10,
                                          .senses_vbus = false,
                                          .product = "VERP on OpenCR"};

inline constexpr Pin kLed = {'G', 9};          ///< STATUS
inline constexpr Pin kServoPower = {'F', 15};  ///< high: powers the DYNAMIXEL connectors

/// MPU-9250, or ICM-20648 on boards from 2020 on.
inline constexpr ImuPort kImu = {.wiring = {.base = stm32::base::kSpi1,
                                            .enable_register = stm32::rcc::kApb2enr,
                                            .mask = stm32::rcc::kApb2Spi1,
                                            .clock = {'A', 5},
                                            .data_in = {'A', 6},
                                            .data_out = {'B', 5},
                                            .select = {'A', 4},
                                            .function = 5},
                                 .on_apb2 = true};
inline constexpr ImuPort kSensorImu = kImu;
/// 3.3 V mean 18.81 V at the battery: variant.cpp, getPowerInVoltage().
inline constexpr stm32::AnalogWiring kBattery = {.base = stm32::base::kAdc3,
                                                 .mask = stm32::rcc::kApb2Adc3,
                                                 .pin = {'C', 0},
                                                 .channel = 10,
                                                 .full_scale_mv = 18'810};
/// Extension connector, pin 3; pin 2 is ground.
inline constexpr Pin kEmergencyStop = {'B', 10};
inline constexpr Button kButtons[2] = {{.pin = {'G', 3}, .pressed_high = true},
                                       {.pin = {'C', 12}, .pressed_high = true}};
inline constexpr Pin kBuzzer = {'F', 14};  ///< no timer channel on it

}  // namespace verp::board
