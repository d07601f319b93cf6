#pragma once
#include "tests/support/stm32/registers/otg_fs_device_table.hpp"

/// OTG_FS in device mode. Paragraphs are those of RM0390 and RM0385, which number every register.
/// RM0090 numbers groups: 34.16.2 global, 34.16.4 device, 34.16.5 power.
namespace verp::hal::stm32::otg_fs {

/// Read-only bits, and those that writing 1 clears.
inline constexpr std::uint32_t kGintRead = kGintCmod | kGintOtg | kGintRxflvl | kGintNptxfe |
                                           kGintGinakeff | kGintGonakeff | kGintIep | kGintOep |
                                           kGintHprt | kGintHc | kGintPtxfe;
inline constexpr std::uint32_t kGintClear =
    kGintMmis | kGintSof | kGintEsusp | kGintUsbsusp | kGintUsbrst | kGintEnumdne | kGintIsoodrp |
    kGintEopf | kGintIisoixfr | kGintIisooxfr | kGintCidschg | kGintDisc | kGintSrq | kGintWkup;
inline constexpr std::uint32_t kGintMaskBits = (kGintRead | kGintClear) & ~kGintCmod;
inline constexpr std::uint32_t kGintNew = kGintRstdet | kGintLpm;
inline constexpr std::uint32_t kGrxstsAll =
    kGrxstsEpnum | kGrxstsBcnt | kGrxstsDpid | kGrxstsPktsts | kGrxstsFrmnum;
inline constexpr std::uint32_t kGotgctlRead =
    kGotgctlSrqscs | kGotgctlHngscs | kGotgctlCidsts | kGotgctlDbct | kGotgctlAsvld | kGotgctlBsvld;
inline constexpr std::uint32_t kGotgctlWrite =
    kGotgctlSrq | kGotgctlHnprq | kGotgctlHshnpen | kGotgctlDhnpen;
inline constexpr std::uint32_t kGotgintAll = kGotgintSedet | kGotgintSrsschg | kGotgintHnsschg |
                                             kGotgintHngdet | kGotgintAdtochg | kGotgintDbcdne;
inline constexpr std::uint32_t kGusbcfgWrite = kGusbcfgTocal | kGusbcfgSrpcap | kGusbcfgHnpcap |
                                               kGusbcfgTrdt | kGusbcfgFhmod | kGusbcfgFdmod |
                                               kGusbcfgCtxpkt;

/// RM0090 prints 0x20000000, a reserved bit. AHBIDL is bit 31, as RM0385 prints.
inline constexpr Register kGrstctlRegister = {
    .name = "GRSTCTL",
    .offset = kGrstctl,
    .paragraph = 5,
    .reset = kGrstctlAhbidl,
    .rw = kGrstctlTxfnum,
    .r = kGrstctlAhbidl,
    .rs = kGrstctlCsrst | kGrstctlHsrst | kGrstctlFcrst | kGrstctlRxfflsh | kGrstctlTxfflsh};
inline constexpr Register kGahbcfgRegister = {
    .name = "GAHBCFG",
    .offset = kGahbcfg,
    .paragraph = 3,
    .rw = kGahbcfgGint | kGahbcfgTxfelvl | kGahbcfgPtxfelvl};
inline constexpr Register kGrxfsizRegister = {
    .name = "GRXFSIZ", .offset = kGrxfsiz, .paragraph = 9, .reset = 0x200, .rw = bits(0, 16)};
inline constexpr Register kHnptxstsRegister = {
    .name = "HNPTXSTS", .offset = kHnptxsts, .paragraph = 11, .reset = 0x80200, .r = bits(0, 31)};

inline constexpr Register kRegistersF405[] = {
    {.name = "GOTGCTL",
     .offset = kGotgctl,
     .paragraph = 1,
     .reset = 0x800,
     .rw = kGotgctlWrite,
     .r = kGotgctlRead},
    {.name = "GOTGINT", .offset = kGotgint, .paragraph = 2, .rc_w1 = kGotgintAll},
    kGahbcfgRegister,
    {.name = "GUSBCFG",
     .offset = kGusbcfg,
     .paragraph = 4,
     .reset = 0xA00,
     .rw = kGusbcfgWrite,
     .w = kGusbcfgPhysel},
    kGrstctlRegister,
    {.name = "GINTSTS",
     .offset = kGintsts,
     .paragraph = 6,
     .reset = 0x04000020,
     .r = kGintRead,
     .rc_w1 = kGintClear},
    {.name = "GINTMSK",
     .offset = kGintmsk,
     .paragraph = 7,
     .rw = (kGintMaskBits | kGintEpmismF405) & ~kGintHprt,
     .r = kGintHprt},
    {.name = "GRXSTSR", .offset = kGrxstsr, .paragraph = 8, .r = kGrxstsAll},
    {.name = "GRXSTSP", .offset = kGrxstsp, .paragraph = 8, .r = kGrxstsAll},
    kGrxfsizRegister,
    {.name = "DIEPTXF0",
     .offset = kDieptxf0,
     .paragraph = 10,
     .reset = 0x200,
     .rw = kDieptxfStart | kDieptxfDepth},
    kHnptxstsRegister,
    {.name = "GCCFG",
     .offset = kGccfg,
     .paragraph = 12,
     .rw = kGccfgPwrdwn | kGccfgVbusasenF405 | kGccfgVbusbsenF405 | kGccfgSofoutenF405 |
           kGccfgNovbussensF405},
    {.name = "CID", .offset = kCid, .paragraph = 13, .reset = 0x1200, .rw = bits(0, 32)},
};
inline constexpr Register kRegistersF7[] = {
    {.name = "GOTGCTL",
     .offset = kGotgctl,
     .paragraph = 1,
     .reset = kGotgctlCidsts,
     .rw = kGotgctlWrite | bits(2, 6) | kGotgctlEhen | kGotgctlOtgver,
     .r = kGotgctlRead | bit(21)},
    {.name = "GOTGINT", .offset = kGotgint, .paragraph = 2, .rc_w1 = kGotgintAll | kGotgintIdchng},
    kGahbcfgRegister,
    {.name = "GUSBCFG",
     .offset = kGusbcfg,
     .paragraph = 4,
     .reset = 0x1440,
     .rw = kGusbcfgWrite,
     .r = kGusbcfgPhysel},
    kGrstctlRegister,
    {.name = "GINTSTS",
     .offset = kGintsts,
     .paragraph = 6,
     .reset = 0x14000020,
     .r = kGintRead,
     .rc_w1 = kGintClear | kGintNew},
    {.name = "GINTMSK", .offset = kGintmsk, .paragraph = 7, .rw = kGintMaskBits | kGintNew},
    {.name = "GRXSTSR", .offset = kGrxstsr, .paragraph = 8, .r = kGrxstsAll | kGrxstsStsphst},
    {.name = "GRXSTSP", .offset = kGrxstsp, .paragraph = 8, .r = kGrxstsAll | kGrxstsStsphst},
    kGrxfsizRegister,
    {.name = "DIEPTXF0",
     .offset = kDieptxf0,
     .paragraph = 10,
     .reset = 0x02000200,
     .rw = kDieptxfStart | kDieptxfDepth},
    kHnptxstsRegister,
    {.name = "GCCFG",
     .offset = kGccfg,
     .paragraph = 12,
     .rw = kGccfgPwrdwn | kGccfgBcden | kGccfgDcden | kGccfgPden | kGccfgSden | kGccfgVbden,
     .r = bits(0, 4)},
    {.name = "CID", .offset = kCid, .paragraph = 13, .reset = 0x3000, .rw = bits(0, 32)},
    {.name = "GLPMCFG",
     .offset = kGlpmcfg,
     .paragraph = 14,
     .rw = bits(0, 13) | bits(17, 7) | bit(28),
     .r = bits(13, 4) | bits(25, 3),
     .rs = bit(24)},
};
/// IN endpoint 1's; each next one is 4 further.
inline constexpr Register kFifoRegisters[] = {
    {.name = "DIEPTXFx",
     .offset = dieptxf(1),
     .paragraph = 16,
     .reset = 0x02000400,
     .rw = kDieptxfStart | kDieptxfDepth},
};

/// RM0385 prints reserved bits as reset value (0x200B8000); ST's library writes 0.
inline constexpr Register kPowerRegisters[] = {
    {.name = "PCGCCTL",
     .offset = 0,
     .paragraph = 58,
     .rw = kPcgcctlStppclk | kPcgcctlGatehclk,
     .r = kPcgcctlPhysusp},
};

inline constexpr Table kTableF405 = make_table("OTG_FS", kManualF405, kRegistersF405);
inline constexpr Table kTableF7 = make_table("OTG_FS", kManualF7, kRegistersF7);
inline constexpr Table kFifoTable = make_table("OTG_FS FIFO size", kManuals, kFifoRegisters);
inline constexpr Table kPowerTable = make_table("OTG_FS power", kManuals, kPowerRegisters);

}  // namespace verp::hal::stm32::otg_fs
