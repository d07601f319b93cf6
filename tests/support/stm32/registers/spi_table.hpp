#pragma once
#include "hal/chip/stm32/registers/spi.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::spi {

constexpr Register status(std::uint32_t levels) {
  return {.name = "SR",
          .offset = kSr,
          .paragraph = 3,
          .reset = 0x2,
          .r = (bits(0, 9) & ~kSrCrcerr) | levels,
          .rc_w0 = kSrCrcerr};
}
inline constexpr Register kCr1Register = {
    .name = "CR1", .offset = kCr1, .paragraph = 1, .rw = bits(0, 16)};
inline constexpr Register kDrRegister = {
    .name = "DR", .offset = kDr, .paragraph = 4, .rw = bits(0, 16)};
inline constexpr Register kCrcprRegister = {
    .name = "CRCPR", .offset = kCrcpr, .paragraph = 5, .reset = 7, .rw = bits(0, 16)};
inline constexpr Register kRxcrcrRegister = {
    .name = "RXCRCR", .offset = kRxcrcr, .paragraph = 6, .r = bits(0, 16)};
inline constexpr Register kTxcrcrRegister = {
    .name = "TXCRCR", .offset = kTxcrcr, .paragraph = 7, .r = bits(0, 16)};
inline constexpr Register kI2sprRegister = {
    .name = "I2SPR", .offset = kI2spr, .paragraph = 9, .reset = 2, .rw = bits(0, 10)};

inline constexpr Register kRegistersF405[] = {
    kCr1Register,    {.name = "CR2", .offset = kCr2, .paragraph = 2, .rw = 0xF7},
    status(0),       kDrRegister,
    kCrcprRegister,  kRxcrcrRegister,
    kTxcrcrRegister, {.name = "I2SCFGR", .offset = kI2scfgr, .paragraph = 8, .rw = 0x0FBF},
    kI2sprRegister,
};
inline constexpr Register kRegistersF446[] = {
    kCr1Register,    {.name = "CR2", .offset = kCr2, .paragraph = 2, .rw = 0xF7},
    status(0),       kDrRegister,
    kCrcprRegister,  kRxcrcrRegister,
    kTxcrcrRegister, {.name = "I2SCFGR", .offset = kI2scfgr, .paragraph = 8, .rw = 0x1FBF},
    kI2sprRegister,
};
inline constexpr Register kRegistersF746[] = {
    kCr1Register,
    {.name = "CR2", .offset = kCr2, .paragraph = 2, .reset = 0x0700, .rw = bits(0, 15)},
    status(kSrFrlvlF7 | kSrFtlvlF7),
    kDrRegister,
    kCrcprRegister,
    kRxcrcrRegister,
    kTxcrcrRegister,
    {.name = "I2SCFGR", .offset = kI2scfgr, .paragraph = 8, .rw = 0x1FBF},
    kI2sprRegister,
};
inline constexpr Table kTableF405 = make_table("SPI", "RM0090 28.5, -, -", kRegistersF405);
inline constexpr Table kTableF446 = make_table("SPI", "-, RM0390 26.7, -", kRegistersF446);
inline constexpr Table kTableF746 = make_table("SPI", "-, -, RM0385 32.9", kRegistersF746);

constexpr const Table& table(Family family) {
  return family == Family::kF405 ? kTableF405 : family == Family::kF446 ? kTableF446 : kTableF746;
}

}  // namespace verp::hal::stm32::spi
