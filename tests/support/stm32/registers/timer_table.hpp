#pragma once
#include "hal/chip/stm32/registers/timer.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::timer {

/// The F7 has one bit more each for counter, slave and compare modes.
constexpr Register cr1(std::uint32_t extra) {
  return {.name = "CR1", .offset = kCr1, .paragraph = 1, .rw = bits(0, 10) | extra};
}
constexpr Register smcr(std::uint32_t extra) {
  return {.name = "SMCR", .offset = kSmcr, .paragraph = 3, .rw = 0xFFF7 | extra};
}
constexpr Register ccmr(const char* name, std::uint32_t offset, std::uint32_t paragraph,
                        std::uint32_t extra) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .rw = bits(0, 16) | extra};
}
constexpr Register word(const char* name, std::uint32_t offset, std::uint32_t paragraph,
                        std::uint32_t reset) {
  return {.name = name, .offset = offset, .paragraph = paragraph, .reset = reset, .rw = ~0u};
}
inline constexpr Register kCr2Register = {
    .name = "CR2", .offset = kCr2, .paragraph = 2, .rw = bits(3, 5)};
inline constexpr Register kDierRegister = {
    .name = "DIER", .offset = kDier, .paragraph = 4, .rw = 0x5F5F};
inline constexpr Register kSrRegister = {
    .name = "SR", .offset = kSr, .paragraph = 5, .rc_w0 = kSrAll};
inline constexpr Register kEgrRegister = {
    .name = "EGR", .offset = kEgr, .paragraph = 6, .w = bits(0, 5) | bit(6)};
inline constexpr Register kCcerRegister = {
    .name = "CCER", .offset = kCcer, .paragraph = 9, .rw = 0xBBBB};
inline constexpr Register kPscRegister = {
    .name = "PSC", .offset = kPsc, .paragraph = 11, .rw = bits(0, 16)};
inline constexpr Register kDcrRegister = {
    .name = "DCR", .offset = kDcr, .paragraph = 17, .rw = bits(0, 5) | bits(8, 5)};
inline constexpr Register kDmarRegister = {
    .name = "DMAR", .offset = kDmar, .paragraph = 18, .rw = bits(0, 16)};
/// TIM2 uses bits 10 and 11, TIM5 bits 6 and 7.
inline constexpr Register kOrRegister = {
    .name = "OR", .offset = kOr, .paragraph = 19, .rw = bits(6, 2) | bits(10, 2)};

inline constexpr Register kRegisters[] = {
    cr1(0),
    kCr2Register,
    smcr(0),
    kDierRegister,
    kSrRegister,
    kEgrRegister,
    ccmr("CCMR1", kCcmr1, 7, 0),
    ccmr("CCMR2", kCcmr2, 8, 0),
    kCcerRegister,
    word("CNT", kCnt, 10, 0),
    kPscRegister,
    word("ARR", kArr, 12, 0xFFFFFFFF),
    word("CCR1", kCcr1, 13, 0),
    word("CCR2", kCcr2, 14, 0),
    word("CCR3", kCcr3, 15, 0),
    word("CCR4", kCcr4, 16, 0),
    kDcrRegister,
    kDmarRegister,
    kOrRegister,
};
inline constexpr Register kRegistersF7[] = {
    cr1(bit(11)),
    kCr2Register,
    smcr(bit(16)),
    kDierRegister,
    kSrRegister,
    kEgrRegister,
    ccmr("CCMR1", kCcmr1, 7, bit(16) | bit(24)),
    ccmr("CCMR2", kCcmr2, 8, bit(16) | bit(24)),
    kCcerRegister,
    word("CNT", kCnt, 10, 0),
    kPscRegister,
    word("ARR", kArr, 12, 0xFFFFFFFF),
    word("CCR1", kCcr1, 13, 0),
    word("CCR2", kCcr2, 14, 0),
    word("CCR3", kCcr3, 15, 0),
    word("CCR4", kCcr4, 16, 0),
    kDcrRegister,
    kDmarRegister,
    kOrRegister,
};
inline constexpr Table kTable = make_table("TIM2/5", "RM0090 18.4, RM0390 17.4, -", kRegisters);
inline constexpr Table kTableF7 = make_table("TIM2/5", "-, -, RM0385 23.4", kRegistersF7);

}  // namespace verp::hal::stm32::timer
