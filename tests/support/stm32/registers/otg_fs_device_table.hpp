#pragma once
#include "hal/chip/stm32/registers/otg_fs.hpp"
#include "tests/support/stm32/registers/table.hpp"

/// Device and endpoint registers of OTG_FS: see otg_fs_table.hpp.
namespace verp::hal::stm32::otg_fs {

inline constexpr char kManualF405[] = "RM0090 34.16, -, -";
inline constexpr char kManualF7[] = "-, RM0390 31.15, RM0385 37.15";
inline constexpr char kManuals[] = "RM0090 34.16, RM0390 31.15, RM0385 37.15";

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
/// Bit 7, TXFE of IN endpoints, is reserved here but set after reset.
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

/// From its DIEPCTL or DOEPCTL.
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

}  // namespace verp::hal::stm32::otg_fs
