#pragma once
#include "hal/chip/stm32/registers/otg_fs.hpp"

/// Registers of OTG_FS in device mode. Paragraphs are those of RM0390 and RM0385, which number
/// every register; RM0090 numbers only its groups: 34.16.2 global, 34.16.4 device, 34.16.5 power.
namespace verp::hal::stm32::otg_fs {

/// Bits of GINTSTS that only tell, and those that software clears by writing 1.
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

/// RM0090 prints 0x20000000, a reserved bit; AHBIDL, which it describes as set when idle, is bit
/// 31, and RM0385 prints that.
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
/// Of IN endpoint 1; the following ones 4 further each.
inline constexpr Register kFifoRegisters[] = {
    {.name = "DIEPTXFx",
     .offset = dieptxf(1),
     .paragraph = 16,
     .reset = 0x02000400,
     .rw = kDieptxfStart | kDieptxfDepth},
};

constexpr Register mask(const char* name, std::uint32_t offset, std::uint32_t paragraph,
                        std::uint32_t all) {
  return {.name = name, .offset = offset - kDevice, .paragraph = paragraph, .rw = all};
}
constexpr Register configuration(std::uint32_t more) {
  return {.name = "DCFG",
          .offset = kDcfg - kDevice,
          .paragraph = 32,
          .reset = 0x02200000,
          .rw = kDcfgDspd | kDcfgNzlsohsk | kDcfgDad | kDcfgPfivl | more};
}
constexpr Register control(std::uint32_t reset, std::uint32_t more) {
  return {.name = "DCTL",
          .offset = kDctl - kDevice,
          .paragraph = 33,
          .reset = reset,
          .rw = kDctlRwusig | kDctlSdis | kDctlTctl | kDctlPoprgdne | more,
          .r = kDctlGinsts | kDctlGonsts,
          .w = kDctlSginak | kDctlCginak | kDctlSgonak | kDctlCgonak};
}
constexpr Register status(std::uint32_t more) {
  return {.name = "DSTS",
          .offset = kDsts - kDevice,
          .paragraph = 34,
          .reset = 0x10,
          .r = kDstsSuspsts | kDstsEnumspd | kDstsEerr | kDstsFnsof | more};
}
inline constexpr Register kDaintRegister = {
    .name = "DAINT", .offset = kDaint - kDevice, .paragraph = 37, .r = bits(0, 32)};
inline constexpr Register kDvbusdisRegister = {.name = "DVBUSDIS",
                                               .offset = kDvbusdis - kDevice,
                                               .paragraph = 39,
                                               .reset = 0x17D7,
                                               .rw = bits(0, 16)};
inline constexpr Register kDvbuspulseRegister = {.name = "DVBUSPULSE",
                                                 .offset = kDvbuspulse - kDevice,
                                                 .paragraph = 40,
                                                 .reset = 0x5B8,
                                                 .rw = bits(0, 12)};

/// From kDevice.
inline constexpr Register kDeviceRegistersF405[] = {
    configuration(0),
    control(0, 0),
    status(0),
    mask("DIEPMSK", kDiepmsk, 35, bits(0, 2) | bits(3, 4)),
    mask("DOEPMSK", kDoepmsk, 36, bits(0, 2) | bits(3, 2)),
    kDaintRegister,
    mask("DAINTMSK", kDaintmsk, 38, bits(0, 32)),
    kDvbusdisRegister,
    kDvbuspulseRegister,
    mask("DIEPEMPMSK", kDiepempmsk, 42, bits(0, 16)),
};
inline constexpr Register kDeviceRegistersF7[] = {
    configuration(bit(15)),
    control(kDctlSdis, bit(18)),
    status(bits(22, 2)),
    mask("DIEPMSK", kDiepmsk, 35, bits(0, 2) | bits(3, 4) | bits(8, 2) | bit(13)),
    mask("DOEPMSK", kDoepmsk, 36, bits(0, 2) | bits(3, 4) | bit(8) | bits(12, 2)),
    kDaintRegister,
    mask("DAINTMSK", kDaintmsk, 38, bits(0, 32)),
    kDvbusdisRegister,
    kDvbuspulseRegister,
    mask("DIEPEMPMSK", kDiepempmsk, 42, bits(0, 16)),
};

constexpr Register in_interrupts(std::uint32_t more) {
  return {.name = "DIEPINTx",
          .offset = kDiepint - kDiepctl,
          .paragraph = 51,
          .reset = kDiepTxfe,
          .r = kDiepInepne | kDiepTxfe,
          .rc_w1 = kDiepXfrc | kDiepEpdisd | kDiepToc | kDiepIttxfe | more};
}
/// Bit 7, TXFE of IN endpoints, is reserved here but set after reset: a write keeps it.
constexpr Register out_interrupts(std::uint32_t more) {
  return {.name = "DOEPINTx",
          .offset = kDoepint - kDoepctl,
          .paragraph = 52,
          .reset = bit(7),
          .rc_w1 = kDoepXfrc | kDoepEpdisd | kDoepStup | kDoepOtepdis | kDoepB2bstup | more};
}
inline constexpr std::uint32_t kInNew =
    kDiepInepnm | kDiepTxfifoudrn | kDiepBna | kDiepPktdrpsts | kDiepNak;
inline constexpr std::uint32_t kOutNew =
    kDoepStsphsrx | kDoepOutpkterr | kDoepBerr | kDoepNak | bit(15);
inline constexpr Register kIn0Register = {.name = "DIEPCTL0",
                                          .offset = 0,
                                          .paragraph = 47,
                                          .reset = kEpctlUsbaep,
                                          .rw = kEpctlMpsiz0 | kDiepctlTxfnum,
                                          .r = kEpctlUsbaep | kEpctlNaksts | kEpctlEptyp,
                                          .w = kEpctlCnak | kEpctlSnak,
                                          .rs = kEpctlStall | kEpctlEpdis | kEpctlEpena};
inline constexpr Register kOut0Register = {
    .name = "DOEPCTL0",
    .offset = 0,
    .paragraph = 49,
    .reset = kEpctlUsbaep,
    .rw = kDoepctlSnpm,
    .r = kEpctlMpsiz0 | kEpctlUsbaep | kEpctlNaksts | kEpctlEptyp | kEpctlEpdis,
    .w = kEpctlCnak | kEpctlSnak | kEpctlEpena,
    .rs = kEpctlStall};
constexpr Register endpoint(const char* name, std::uint32_t paragraph, std::uint32_t own) {
  return {.name = name,
          .offset = 0,
          .paragraph = paragraph,
          .rw = kEpctlMpsiz | kEpctlUsbaep | kEpctlEptyp | kEpctlStall | own,
          .r = kEpctlDpid | kEpctlNaksts,
          .w = kEpctlCnak | kEpctlSnak | kEpctlSd0pid | kEpctlSd1pid,
          .rs = kEpctlEpdis | kEpctlEpena};
}
constexpr Register size(const char* name, std::uint32_t paragraph, std::uint32_t all) {
  return {.name = name, .offset = kDieptsiz - kDiepctl, .paragraph = paragraph, .rw = all};
}
inline constexpr Register kDtxfstsRegister = {.name = "DTXFSTSx",
                                              .offset = kDtxfsts - kDiepctl,
                                              .paragraph = 56,
                                              .reset = 0x200,
                                              .r = bits(0, 16)};

/// One endpoint each: from its DIEPCTL or DOEPCTL.
inline constexpr Register kIn0RegistersF405[] = {
    kIn0Register, in_interrupts(0), size("DIEPTSIZ0", 53, kTsizXfrsiz0 | kDieptsizPktcnt0),
    kDtxfstsRegister};
inline constexpr Register kIn0RegistersF7[] = {
    kIn0Register, in_interrupts(kInNew), size("DIEPTSIZ0", 53, kTsizXfrsiz0 | kDieptsizPktcnt0),
    kDtxfstsRegister};
inline constexpr Register kInRegistersF405[] = {
    endpoint("DIEPCTLx", 48, kDiepctlTxfnum), in_interrupts(0),
    size("DIEPTSIZx", 55, kTsizXfrsiz | kTsizPktcnt | kDieptsizMcnt), kDtxfstsRegister};
inline constexpr Register kInRegistersF7[] = {
    endpoint("DIEPCTLx", 48, kDiepctlTxfnum), in_interrupts(kInNew),
    size("DIEPTSIZx", 55, kTsizXfrsiz | kTsizPktcnt | kDieptsizMcnt), kDtxfstsRegister};
inline constexpr Register kOut0RegistersF405[] = {
    kOut0Register, out_interrupts(0),
    size("DOEPTSIZ0", 54, kTsizXfrsiz0 | kDoeptsizPktcnt0 | kDoeptsizStupcnt)};
inline constexpr Register kOut0RegistersF7[] = {
    kOut0Register, out_interrupts(kOutNew),
    size("DOEPTSIZ0", 54, kTsizXfrsiz0 | kDoeptsizPktcnt0 | kDoeptsizStupcnt)};
inline constexpr Register kOutRegistersF405[] = {
    endpoint("DOEPCTLx", 50, kDoepctlSnpm), out_interrupts(0),
    size("DOEPTSIZx", 57, kTsizXfrsiz | kTsizPktcnt | kDoeptsizStupcnt)};
inline constexpr Register kOutRegistersF7[] = {
    endpoint("DOEPCTLx", 50, kDoepctlSnpm), out_interrupts(kOutNew),
    size("DOEPTSIZx", 57, kTsizXfrsiz | kTsizPktcnt | kDoeptsizStupcnt)};

/// From kPcgcctl. RM0385 prints a reset value of reserved bits alone (0x200B8000), over which ST's
/// own library writes 0.
inline constexpr Register kPowerRegisters[] = {
    {.name = "PCGCCTL",
     .offset = 0,
     .paragraph = 58,
     .rw = kPcgcctlStppclk | kPcgcctlGatehclk,
     .r = kPcgcctlPhysusp},
};

inline constexpr char kManualF405[] = "RM0090 34.16, -, -";
inline constexpr char kManualF7[] = "-, RM0390 31.15, RM0385 37.15";
inline constexpr char kManuals[] = "RM0090 34.16, RM0390 31.15, RM0385 37.15";
inline constexpr Table kTableF405 = make_table("OTG_FS", kManualF405, kRegistersF405);
inline constexpr Table kTableF7 = make_table("OTG_FS", kManualF7, kRegistersF7);
inline constexpr Table kFifoTable = make_table("OTG_FS FIFO size", kManuals, kFifoRegisters);
inline constexpr Table kDeviceTableF405 =
    make_table("OTG_FS device", kManualF405, kDeviceRegistersF405);
inline constexpr Table kDeviceTableF7 = make_table("OTG_FS device", kManualF7, kDeviceRegistersF7);
inline constexpr Table kIn0TableF405 = make_table("OTG_FS IN 0", kManualF405, kIn0RegistersF405);
inline constexpr Table kIn0TableF7 = make_table("OTG_FS IN 0", kManualF7, kIn0RegistersF7);
inline constexpr Table kInTableF405 = make_table("OTG_FS IN", kManualF405, kInRegistersF405);
inline constexpr Table kInTableF7 = make_table("OTG_FS IN", kManualF7, kInRegistersF7);
inline constexpr Table kOut0TableF405 = make_table("OTG_FS OUT 0", kManualF405, kOut0RegistersF405);
inline constexpr Table kOut0TableF7 = make_table("OTG_FS OUT 0", kManualF7, kOut0RegistersF7);
inline constexpr Table kOutTableF405 = make_table("OTG_FS OUT", kManualF405, kOutRegistersF405);
inline constexpr Table kOutTableF7 = make_table("OTG_FS OUT", kManualF7, kOutRegistersF7);
inline constexpr Table kPowerTable = make_table("OTG_FS power", kManuals, kPowerRegisters);

}  // namespace verp::hal::stm32::otg_fs
