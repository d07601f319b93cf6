#pragma once
#include "hal/chip/stm32/registers/can.hpp"
#include "tests/support/stm32/registers/table.hpp"

namespace verp::hal::stm32::can {

inline constexpr std::uint32_t kTsrDone = kTsrRqcp | kTsrTxok | kTsrAlst | kTsrTerr;

inline constexpr Register kRegisters[] = {
    {.name = "MCR",
     .offset = kMcr,
     .paragraph = 2,
     .reset = 0x00010002,
     .rw = bits(0, 8) | kMcrDbf,
     .rs = kMcrReset},
    {.name = "MSR",
     .offset = kMsr,
     .paragraph = 2,
     .reset = 0x00000C02,
     .r = kMsrInak | kMsrSlak | kMsrTxm | kMsrRxm | kMsrSamp | kMsrRx,
     .rc_w1 = kMsrErri | kMsrWkui | kMsrSlaki},
    {.name = "TSR",
     .offset = kTsr,
     .paragraph = 2,
     .reset = 0x1C000000,
     .r = bits(24, 8),
     .rs = kTsrAbrq * 0x010101,
     .rc_w1 = kTsrDone * 0x010101},
    {.name = "RF0R",
     .offset = kRf0r,
     .paragraph = 2,
     .r = kRfrFmp,
     .rs = kRfrRfom,
     .rc_w1 = kRfrFull | kRfrFovr},
    {.name = "RF1R",
     .offset = kRf1r,
     .paragraph = 2,
     .r = kRfrFmp,
     .rs = kRfrRfom,
     .rc_w1 = kRfrFull | kRfrFovr},
    {.name = "IER", .offset = kIer, .paragraph = 2, .rw = 0x00038F7F},
    {.name = "ESR",
     .offset = kEsr,
     .paragraph = 2,
     .rw = kEsrLec,
     .r = kEsrEwgf | kEsrEpvf | kEsrBoff | kEsrTec | kEsrRec},
    {.name = "BTR",
     .offset = kBtr,
     .paragraph = 2,
     .reset = 0x01230000,
     .rw = kBtrBrp | kBtrTs1 | kBtrTs2 | kBtrSjw | kBtrLbkm | kBtrSilm},
};
// A mailbox's reset content is undefined but holds no request.
inline constexpr Register kTransmitRegisters[] = {
    {.name = "TIR", .offset = kTir, .paragraph = 3, .rw = bits(0, 32)},
    {.name = "TDTR", .offset = kTdtr, .paragraph = 3, .rw = kDtrDlc | kDtrTgt | kDtrTime},
    {.name = "TDLR", .offset = kTdlr, .paragraph = 3, .rw = bits(0, 32)},
    {.name = "TDHR", .offset = kTdhr, .paragraph = 3, .rw = bits(0, 32)},
};
inline constexpr Register kReceiveRegisters[] = {
    {.name = "RIR", .offset = kRir, .paragraph = 3, .r = bits(1, 31)},
    {.name = "RDTR", .offset = kRdtr, .paragraph = 3, .r = kDtrDlc | kDtrFmi | kDtrTime},
    {.name = "RDLR", .offset = kRdlr, .paragraph = 3, .r = bits(0, 32)},
    {.name = "RDHR", .offset = kRdhr, .paragraph = 3, .r = bits(0, 32)},
};
inline constexpr Register kFilterRegisters[] = {
    {.name = "FMR",
     .offset = kFmr,
     .paragraph = 4,
     .reset = 0x2A1C0E01,
     .rw = kFmrFinit | kFmrCan2sb},
    {.name = "FM1R", .offset = kFm1r, .paragraph = 4, .rw = bits(0, kBanks)},
    {.name = "FS1R", .offset = kFs1r, .paragraph = 4, .rw = bits(0, kBanks)},
    {.name = "FFA1R", .offset = kFfa1r, .paragraph = 4, .rw = bits(0, kBanks)},
    {.name = "FA1R", .offset = kFa1r, .paragraph = 4, .rw = bits(0, kBanks)},
};
inline constexpr Register kBankRegisters[] = {
    {.name = "FR1", .offset = kFr1, .paragraph = 4, .rw = bits(0, 32)},
    {.name = "FR2", .offset = kFr2, .paragraph = 4, .rw = bits(0, 32)},
};
inline constexpr const char* kManuals = "RM0090 32.9, RM0390 30.9, RM0385 36.9";
inline constexpr Table kTable = make_table("CAN", kManuals, kRegisters);
inline constexpr Table kTransmitTable = make_table("CAN mailbox", kManuals, kTransmitRegisters);
inline constexpr Table kReceiveTable = make_table("CAN FIFO", kManuals, kReceiveRegisters);
inline constexpr Table kFilterTable = make_table("CAN filters", kManuals, kFilterRegisters);
inline constexpr Table kBankTable = make_table("CAN filter bank", kManuals, kBankRegisters);

}  // namespace verp::hal::stm32::can
