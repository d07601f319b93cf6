#pragma once
#include "hal/chip/stm32/registers/memory_map.hpp"

/// For VERP's peripherals: RM0090 tables 43 and 44, RM0390 tables 28 and 29, RM0385 tables 25 and
/// 26.
namespace verp::hal::stm32::dma {

struct Request {
  std::uint32_t peripheral;  ///< base address
  bool transmit;             ///< to the peripheral
  std::uint8_t controller;   ///< 1 or 2
  std::uint8_t stream;
  std::uint8_t channel;
};

inline constexpr Request kRequests[] = {
    {base::kSpi3, false, 1, 0, 0},      {base::kSpi3, false, 1, 2, 0},
    {base::kSpi2, false, 1, 3, 0},      {base::kSpi2, true, 1, 4, 0},
    {base::kSpi3, true, 1, 5, 0},       {base::kSpi3, true, 1, 7, 0},
    {base::kI2c1, false, 1, 0, 1},      {base::kI2c1, false, 1, 5, 1},
    {base::kI2c1, true, 1, 6, 1},       {base::kI2c1, true, 1, 7, 1},
    {base::kI2c3, false, 1, 2, 3},      {base::kI2c3, true, 1, 4, 3},
    {base::kUart5, false, 1, 0, 4},     {base::kUsart3, false, 1, 1, 4},
    {base::kUart4, false, 1, 2, 4},     {base::kUsart3, true, 1, 3, 4},
    {base::kUart4, true, 1, 4, 4},      {base::kUsart2, false, 1, 5, 4},
    {base::kUsart2, true, 1, 6, 4},     {base::kUart5, true, 1, 7, 4},
    {base::kUsart3, true, 1, 4, 7},     {base::kI2c2, false, 1, 2, 7},
    {base::kI2c2, false, 1, 3, 7},      {base::kI2c2, true, 1, 7, 7},
    {base::kUart8F746, true, 1, 0, 5},  {base::kUart7F746, true, 1, 1, 5},
    {base::kUart7F746, false, 1, 3, 5}, {base::kUart8F746, false, 1, 6, 5},
    {base::kAdc1, false, 2, 0, 0},      {base::kAdc1, false, 2, 4, 0},
    {base::kAdc2, false, 2, 2, 1},      {base::kAdc2, false, 2, 3, 1},
    {base::kAdc3, false, 2, 0, 2},      {base::kAdc3, false, 2, 1, 2},
    {base::kSpi1, false, 2, 0, 3},      {base::kSpi1, false, 2, 2, 3},
    {base::kSpi1, true, 2, 3, 3},       {base::kSpi1, true, 2, 5, 3},
    {base::kUsart1, false, 2, 2, 4},    {base::kUsart1, false, 2, 5, 4},
    {base::kUsart1, true, 2, 7, 4},     {base::kUsart6, false, 2, 1, 5},
    {base::kUsart6, false, 2, 2, 5},    {base::kUsart6, true, 2, 6, 5},
    {base::kUsart6, true, 2, 7, 5},
};

}  // namespace verp::hal::stm32::dma
