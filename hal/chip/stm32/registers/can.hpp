#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// bxCAN, the same in all three families. CAN1 also holds CAN2's filters.
namespace verp::hal::stm32::can {

inline constexpr std::uint32_t kMcr = 0x00, kMsr = 0x04, kTsr = 0x08, kRf0r = 0x0C, kRf1r = 0x10,
                               kIer = 0x14, kEsr = 0x18, kBtr = 0x1C;
/// Mailbox 0; the others every kMailboxStep.
inline constexpr std::uint32_t kTir = 0x180, kTdtr = 0x184, kTdlr = 0x188, kTdhr = 0x18C;
/// FIFO 0; FIFO 1 follows at kMailboxStep.
inline constexpr std::uint32_t kRir = 0x1B0, kRdtr = 0x1B4, kRdlr = 0x1B8, kRdhr = 0x1BC;
inline constexpr std::uint32_t kMailboxStep = 0x10;
inline constexpr unsigned kMailboxes = 3, kFifos = 2, kFifoDepth = 3;
inline constexpr std::uint32_t kFmr = 0x200, kFm1r = 0x204, kFs1r = 0x20C, kFfa1r = 0x214,
                               kFa1r = 0x21C;
/// Bank 0; the others every kBankStep.
inline constexpr std::uint32_t kFr1 = 0x240, kFr2 = 0x244, kBankStep = 8;
inline constexpr unsigned kBanks = 28;

inline constexpr std::uint32_t kMcrInrq = bit(0), kMcrSleep = bit(1), kMcrTxfp = bit(2),
                               kMcrRflm = bit(3), kMcrNart = bit(4), kMcrAwum = bit(5),
                               kMcrAbom = bit(6), kMcrTtcm = bit(7), kMcrReset = bit(15),
                               kMcrDbf = bit(16);
inline constexpr std::uint32_t kMsrInak = bit(0), kMsrSlak = bit(1), kMsrErri = bit(2),
                               kMsrWkui = bit(3), kMsrSlaki = bit(4), kMsrTxm = bit(8),
                               kMsrRxm = bit(9), kMsrSamp = bit(10), kMsrRx = bit(11);
/// Mailbox 0; the others every 8 bits.
inline constexpr std::uint32_t kTsrRqcp = bit(0), kTsrTxok = bit(1), kTsrAlst = bit(2),
                               kTsrTerr = bit(3), kTsrAbrq = bit(7);
inline constexpr unsigned kTsrMailboxBits = 8;
/// Mailbox 0; the others every bit.
inline constexpr std::uint32_t kTsrTme = bit(26);
inline constexpr std::uint32_t kRfrFmp = bits(0, 2), kRfrFull = bit(3), kRfrFovr = bit(4),
                               kRfrRfom = bit(5);
inline constexpr std::uint32_t kIerTmeie = bit(0), kIerFmpie0 = bit(1), kIerFfie0 = bit(2),
                               kIerFovie0 = bit(3), kIerEwgie = bit(8), kIerEpvie = bit(9),
                               kIerBofie = bit(10), kIerLecie = bit(11), kIerErrie = bit(15);
inline constexpr std::uint32_t kEsrEwgf = bit(0), kEsrEpvf = bit(1), kEsrBoff = bit(2),
                               kEsrLec = bits(4, 3), kEsrTec = bits(16, 8), kEsrRec = bits(24, 8);
inline constexpr unsigned kEsrLecShift = 4, kEsrTecShift = 16;
/// LEC. Hardware never writes kLecUnused: software does, to see the next error.
inline constexpr std::uint32_t kLecNone = 0, kLecStuff = 1, kLecAck = 3, kLecRecessive = 4,
                               kLecUnused = 7;
/// Fields hold their values minus 1.
inline constexpr std::uint32_t kBtrBrp = bits(0, 10), kBtrTs1 = bits(16, 4), kBtrTs2 = bits(20, 3),
                               kBtrSjw = bits(24, 2), kBtrLbkm = bit(30), kBtrSilm = bit(31);
inline constexpr unsigned kBtrTs1Shift = 16, kBtrTs2Shift = 20, kBtrSjwShift = 24;
/// TIR and RIR; TXRQ only in TIR. A 32-bit filter has the same layout.
inline constexpr std::uint32_t kIrTxrq = bit(0), kIrRtr = bit(1), kIrIde = bit(2);
inline constexpr unsigned kIrExidShift = 3, kIrStidShift = 21;
inline constexpr std::uint32_t kDtrDlc = bits(0, 4), kDtrTgt = bit(8), kDtrFmi = bits(8, 8),
                               kDtrTime = bits(16, 16);
inline constexpr std::uint32_t kFmrFinit = bit(0), kFmrCan2sb = bits(8, 6);
/// CAN2SB after a reset: CAN2's first filter bank.
inline constexpr unsigned kFmrCan2sbShift = 8, kCan2FirstBank = 14;

}  // namespace verp::hal::stm32::can
