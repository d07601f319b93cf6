#pragma once
#include "boards/stm32/wiring.hpp"

/// For an F405 or F446 in a 64-pin package.
namespace verp::board {

/// USART1; the direction pin is PB5.
constexpr SerialPort f4_servo_port(Pin transmit, Pin receive) {
  return {.wiring = {.base = hal::stm32::base::kUsart1,
                     .dma_base = hal::stm32::base::kDma2,
                     .dma_stream = 2,
                     .dma_channel = 4,
                     .direction = {'B', 5}},
          .transmit = transmit,
          .receive = receive,
          .function = 7,
          .gate = {hal::stm32::rcc::kApb2enr, hal::stm32::rcc::kApb2Usart1},
          .dma_gate = {hal::stm32::rcc::kAhb1enr, hal::stm32::rcc::kAhb1Dma2},
          .on_apb2 = true,
          .interrupt = hal::stm32::irq::kUsart1,
          .dma_interrupt = hal::stm32::irq::dma2(2)};
}
/// CAN1 on PB8 and PB9, to a CAN transceiver.
inline constexpr CanPort kF4CanPort = {.base = hal::stm32::base::kCan1,
                                       .filters = {},
                                       .clocks = hal::stm32::rcc::kApb1Can1,
                                       .transmit = {'B', 9},
                                       .receive = {'B', 8},
                                       .function = 9,
                                       .first_interrupt = hal::stm32::irq::kCan1Tx};
/// SPI2 on PB12 to PB15, to a motion sensor: image `sensor` only.
inline constexpr ImuPort kF4SensorImu = {.wiring = {.base = hal::stm32::base::kSpi2,
                                                    .enable_register = hal::stm32::rcc::kApb1enr,
                                                    .mask = hal::stm32::rcc::kApb1Spi2,
                                                    .clock = {'B', 13},
                                                    .data_in = {'B', 14},
                                                    .data_out = {'B', 15},
                                                    .select = {'B', 12},
                                                    .function = 5},
                                         .on_apb2 = false};
/// ADC1 on PC0 to PC3: image `foot` only.
inline constexpr FootPort kF4FootPort = {.cells = {.base = hal::stm32::base::kAdc1,
                                                   .mask = hal::stm32::rcc::kApb2Adc1,
                                                   .pin = {{'C', 0}, {'C', 1}, {'C', 2}, {'C', 3}},
                                                   .channel = {10, 11, 12, 13}},
                                         .right = {'C', 4}};
/// USART2 on PA2 and PA3.
inline constexpr SerialPort kF4OperatorPort = {
    .wiring = {.base = hal::stm32::base::kUsart2,
               .dma_base = hal::stm32::base::kDma1,
               .dma_stream = 5,
               .dma_channel = 4,
               .direction = {}},
    .transmit = {'A', 2},
    .receive = {'A', 3},
    .function = 7,
    .gate = {hal::stm32::rcc::kApb1enr, hal::stm32::rcc::kApb1Usart2},
    .dma_gate = {hal::stm32::rcc::kAhb1enr, hal::stm32::rcc::kAhb1Dma1},
    .on_apb2 = false,
    .interrupt = hal::stm32::irq::kUsart2,
    .dma_interrupt = hal::stm32::irq::dma1(5),
    .baud = 1'000'000};

}  // namespace verp::board
