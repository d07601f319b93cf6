#pragma once
#include "hal/chip/stm32/registers/table.hpp"

/// I2C: the F4's older kind and the F7's newer one.
namespace verp::hal::stm32 {

namespace i2c_v1 {

inline constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kOar1 = 0x08, kOar2 = 0x0C, kDr = 0x10,
                               kSr1 = 0x14, kSr2 = 0x18, kCcr = 0x1C, kTrise = 0x20,
                               kFltrF446 = 0x24;

inline constexpr std::uint32_t kCr1Pe = bit(0), kCr1Nostretch = bit(7), kCr1Start = bit(8),
                               kCr1Stop = bit(9), kCr1Ack = bit(10), kCr1Pos = bit(11),
                               kCr1Swrst = bit(15);
inline constexpr std::uint32_t kCr2Freq = bits(0, 6), kCr2Iterren = bit(8), kCr2Itevten = bit(9),
                               kCr2Itbufen = bit(10), kCr2Dmaen = bit(11), kCr2Last = bit(12);
inline constexpr std::uint32_t kOar1KeepSet = bit(14);  ///< "should always be kept at 1"
inline constexpr std::uint32_t kSr1Sb = bit(0), kSr1Addr = bit(1), kSr1Btf = bit(2),
                               kSr1Stopf = bit(4), kSr1Rxne = bit(6), kSr1Txe = bit(7),
                               kSr1Berr = bit(8), kSr1Arlo = bit(9), kSr1Af = bit(10),
                               kSr1Ovr = bit(11), kSr1Pecerr = bit(12), kSr1Timeout = bit(14),
                               kSr1Smbalert = bit(15);
inline constexpr std::uint32_t kSr1Errors =
    kSr1Berr | kSr1Arlo | kSr1Af | kSr1Ovr | kSr1Pecerr | kSr1Timeout | kSr1Smbalert;
inline constexpr std::uint32_t kSr2Msl = bit(0), kSr2Busy = bit(1), kSr2Tra = bit(2);
inline constexpr std::uint32_t kCcrCcr = bits(0, 12), kCcrDuty = bit(14), kCcrFs = bit(15);

inline constexpr Register kCr1Register = {
    .name = "CR1", .offset = kCr1, .paragraph = 1, .rw = 0xBFFB};
inline constexpr Register kCr2Register = {
    .name = "CR2", .offset = kCr2, .paragraph = 2, .rw = 0x1F3F};
inline constexpr Register kOar1Register = {
    .name = "OAR1", .offset = kOar1, .paragraph = 3, .rw = 0xC3FF};
inline constexpr Register kOar2Register = {
    .name = "OAR2", .offset = kOar2, .paragraph = 4, .rw = bits(0, 8)};
inline constexpr Register kDrRegister = {
    .name = "DR", .offset = kDr, .paragraph = 5, .rw = bits(0, 8)};
inline constexpr Register kSr1Register = {.name = "SR1",
                                          .offset = kSr1,
                                          .paragraph = 6,
                                          .r = bits(0, 5) | bits(6, 2),
                                          .rc_w0 = kSr1Errors};
inline constexpr Register kSr2Register = {
    .name = "SR2", .offset = kSr2, .paragraph = 7, .r = 0xFFF7};
inline constexpr Register kCcrRegister = {
    .name = "CCR", .offset = kCcr, .paragraph = 8, .rw = 0xCFFF};
inline constexpr Register kTriseRegister = {
    .name = "TRISE", .offset = kTrise, .paragraph = 9, .reset = 2, .rw = bits(0, 6)};

inline constexpr Register kRegistersF405[] = {
    kCr1Register, kCr2Register, kOar1Register, kOar2Register,  kDrRegister,
    kSr1Register, kSr2Register, kCcrRegister,  kTriseRegister,
};
inline constexpr Register kRegistersF446[] = {
    kCr1Register,   kCr2Register,
    kOar1Register,  kOar2Register,
    kDrRegister,    kSr1Register,
    kSr2Register,   kCcrRegister,
    kTriseRegister, {.name = "FLTR", .offset = kFltrF446, .paragraph = 10, .rw = bits(0, 5)},
};
inline constexpr Table kTableF405 = make_table("I2C", "RM0090 27.6, -, -", kRegistersF405);
inline constexpr Table kTableF446 = make_table("I2C", "-, RM0390 24.6, -", kRegistersF446);

}  // namespace i2c_v1

namespace i2c_v2 {

inline constexpr std::uint32_t kCr1 = 0x00, kCr2 = 0x04, kOar1 = 0x08, kOar2 = 0x0C,
                               kTimingr = 0x10, kTimeoutr = 0x14, kIsr = 0x18, kIcr = 0x1C,
                               kPecr = 0x20, kRxdr = 0x24, kTxdr = 0x28;

inline constexpr std::uint32_t kCr1Pe = bit(0), kCr1Anfoff = bit(12);
inline constexpr std::uint32_t kCr2Sadd = bits(0, 10), kCr2RdWrn = bit(10), kCr2Start = bit(13),
                               kCr2Stop = bit(14), kCr2Nack = bit(15), kCr2Nbytes = bits(16, 8),
                               kCr2Reload = bit(24), kCr2Autoend = bit(25);
inline constexpr unsigned kCr2NbytesShift = 16;
inline constexpr std::uint32_t kIsrTxe = bit(0), kIsrTxis = bit(1), kIsrRxne = bit(2),
                               kIsrAddr = bit(3), kIsrNackf = bit(4), kIsrStopf = bit(5),
                               kIsrTc = bit(6), kIsrTcr = bit(7), kIsrBerr = bit(8),
                               kIsrArlo = bit(9), kIsrOvr = bit(10), kIsrTimeout = bit(12),
                               kIsrBusy = bit(15);
/// ICR clears the ISR bits of the same number.
inline constexpr std::uint32_t kIcrAll = 0x3F38;

inline constexpr Register kRegisters[] = {
    {.name = "CR1", .offset = kCr1, .paragraph = 1, .rw = 0x00FBDFFF},
    {.name = "CR2",
     .offset = kCr2,
     .paragraph = 2,
     .rw = bits(0, 13) | bits(16, 10),
     .rs = bits(13, 3) | bit(26)},
    {.name = "OAR1", .offset = kOar1, .paragraph = 3, .rw = 0x87FF},
    {.name = "OAR2", .offset = kOar2, .paragraph = 4, .rw = 0x87FE},
    {.name = "TIMINGR", .offset = kTimingr, .paragraph = 5, .rw = 0xF0FFFFFF},
    {.name = "TIMEOUTR", .offset = kTimeoutr, .paragraph = 6, .rw = 0x8FFF9FFF},
    {.name = "ISR",
     .offset = kIsr,
     .paragraph = 7,
     .reset = 1,
     .r = bits(2, 12) | bits(15, 9),
     .rs = bits(0, 2)},
    {.name = "ICR", .offset = kIcr, .paragraph = 8, .w = kIcrAll},
    {.name = "PECR", .offset = kPecr, .paragraph = 9, .r = bits(0, 8)},
    {.name = "RXDR", .offset = kRxdr, .paragraph = 10, .r = bits(0, 8)},
    {.name = "TXDR", .offset = kTxdr, .paragraph = 11, .rw = bits(0, 8)},
};
inline constexpr Table kTable = make_table("I2C", "-, -, RM0385 30.7", kRegisters);

}  // namespace i2c_v2

}  // namespace verp::hal::stm32
