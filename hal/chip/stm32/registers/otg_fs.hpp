#pragma once
#include "hal/chip/stm32/registers/bits.hpp"

/// Device mode; offsets from kOtgFs (tables: otg_fs_tables.hpp). The F446 and F746 have a newer
/// core than the F405: 6 endpoints each way, other GCCFG bits, and disconnected (SDIS) after reset.
namespace verp::hal::stm32::otg_fs {

/// Endpoints each way, 0 included, and the FIFO words that they share: one part for all received
/// data, one for each IN endpoint (RM0090 34.1, RM0385 37.4).
constexpr unsigned endpoints(Family family) {
  return family == Family::kF405 ? 4 : 6;
}
inline constexpr std::uint32_t kFifoWords = 320;
/// Minimum of GRXFSIZ and each transmit FIFO.
inline constexpr std::uint32_t kFifoWordsMin = 16;

inline constexpr std::uint32_t kGotgctl = 0x00, kGotgint = 0x04, kGahbcfg = 0x08, kGusbcfg = 0x0C,
                               kGrstctl = 0x10, kGintsts = 0x14, kGintmsk = 0x18, kGrxstsr = 0x1C,
                               kGrxstsp = 0x20, kGrxfsiz = 0x24, kDieptxf0 = 0x28, kHnptxsts = 0x2C,
                               kGccfg = 0x38, kCid = 0x3C;
inline constexpr std::uint32_t kGlpmcfg = 0x54;  ///< not on the F405
/// Endpoint 0's is kDieptxf0.
constexpr std::uint32_t dieptxf(unsigned endpoint) {
  return endpoint == 0 ? kDieptxf0 : 0x100 + 4 * endpoint;
}
inline constexpr std::uint32_t kDevice = 0x800, kDcfg = 0x800, kDctl = 0x804, kDsts = 0x808,
                               kDiepmsk = 0x810, kDoepmsk = 0x814, kDaint = 0x818,
                               kDaintmsk = 0x81C, kDvbusdis = 0x828, kDvbuspulse = 0x82C,
                               kDiepempmsk = 0x834;
/// Endpoint 0; the others every kEndpointStep.
inline constexpr std::uint32_t kDiepctl = 0x900, kDiepint = 0x908, kDieptsiz = 0x910,
                               kDtxfsts = 0x918, kDoepctl = 0xB00, kDoepint = 0xB08,
                               kDoeptsiz = 0xB10, kEndpointStep = 0x20;
constexpr std::uint32_t diepctl(unsigned endpoint) {
  return kDiepctl + kEndpointStep * endpoint;
}
constexpr std::uint32_t diepint(unsigned endpoint) {
  return kDiepint + kEndpointStep * endpoint;
}
constexpr std::uint32_t dieptsiz(unsigned endpoint) {
  return kDieptsiz + kEndpointStep * endpoint;
}
constexpr std::uint32_t dtxfsts(unsigned endpoint) {
  return kDtxfsts + kEndpointStep * endpoint;
}
constexpr std::uint32_t doepctl(unsigned endpoint) {
  return kDoepctl + kEndpointStep * endpoint;
}
constexpr std::uint32_t doepint(unsigned endpoint) {
  return kDoepint + kEndpointStep * endpoint;
}
constexpr std::uint32_t doeptsiz(unsigned endpoint) {
  return kDoeptsiz + kEndpointStep * endpoint;
}
inline constexpr std::uint32_t kPcgcctl = 0xE00;
/// A 4 KB window: a write pushes a word to that IN endpoint's FIFO; a read in any window pops a
/// word of the receive FIFO.
constexpr std::uint32_t fifo(unsigned endpoint) {
  return 0x1000 * (endpoint + 1);
}

inline constexpr std::uint32_t kGotgctlSrqscs = bit(0), kGotgctlSrq = bit(1),
                               kGotgctlHngscs = bit(8), kGotgctlHnprq = bit(9),
                               kGotgctlHshnpen = bit(10), kGotgctlDhnpen = bit(11),
                               kGotgctlCidsts = bit(16), kGotgctlDbct = bit(17),
                               kGotgctlAsvld = bit(18), kGotgctlBsvld = bit(19);
/// Not on the F405 (which has NOVBUSSENS): override of the VBUS comparator.
inline constexpr std::uint32_t kGotgctlBvaloen = bit(6), kGotgctlBvaloval = bit(7),
                               kGotgctlEhen = bit(12), kGotgctlOtgver = bit(20);
inline constexpr std::uint32_t kGotgintSedet = bit(2), kGotgintSrsschg = bit(8),
                               kGotgintHnsschg = bit(9), kGotgintHngdet = bit(17),
                               kGotgintAdtochg = bit(18), kGotgintDbcdne = bit(19);
inline constexpr std::uint32_t kGotgintIdchng = bit(20);  ///< not on the F405
inline constexpr std::uint32_t kGahbcfgGint = bit(0), kGahbcfgTxfelvl = bit(7),
                               kGahbcfgPtxfelvl = bit(8);
/// TRDT: see turnaround(). After FDMOD the core needs 25 ms to become a device.
inline constexpr std::uint32_t kGusbcfgTocal = bits(0, 3), kGusbcfgPhysel = bit(6),
                               kGusbcfgSrpcap = bit(8), kGusbcfgHnpcap = bit(9),
                               kGusbcfgTrdt = bits(10, 4), kGusbcfgFhmod = bit(29),
                               kGusbcfgFdmod = bit(30), kGusbcfgCtxpkt = bit(31);
inline constexpr unsigned kGusbcfgTrdtShift = 10;
inline constexpr std::uint32_t kForceModeTime_ms = 25;
/// Least TRDT for an AHB clock (RM0090 table "TRDT values", RM0385 37.14.7); 0 below 14.2 MHz,
/// where the core cannot work.
constexpr std::uint32_t turnaround(std::uint32_t hclk_hz) {
  constexpr std::uint32_t kFrom_hz[] = {32000000, 27500000, 24000000, 21800000, 20000000,
                                        18500000, 17200000, 16000000, 15000000, 14200000};
  for (std::uint32_t i = 0; i < 10; ++i) {
    if (hclk_hz >= kFrom_hz[i]) return 6 + i;
  }
  return 0;
}

inline constexpr std::uint32_t kGrstctlCsrst = bit(0), kGrstctlHsrst = bit(1),
                               kGrstctlFcrst = bit(2), kGrstctlRxfflsh = bit(4),
                               kGrstctlTxfflsh = bit(5), kGrstctlTxfnum = bits(6, 5),
                               kGrstctlAhbidl = bit(31);
inline constexpr unsigned kGrstctlTxfnumShift = 6;
inline constexpr std::uint32_t kGrstctlAllTxFifos = 0x10u << kGrstctlTxfnumShift;

/// GINTSTS and GINTMSK.
inline constexpr std::uint32_t kGintCmod = bit(0), kGintMmis = bit(1), kGintOtg = bit(2),
                               kGintSof = bit(3), kGintRxflvl = bit(4), kGintNptxfe = bit(5),
                               kGintGinakeff = bit(6), kGintGonakeff = bit(7), kGintEsusp = bit(10),
                               kGintUsbsusp = bit(11), kGintUsbrst = bit(12),
                               kGintEnumdne = bit(13), kGintIsoodrp = bit(14), kGintEopf = bit(15),
                               kGintIep = bit(18), kGintOep = bit(19), kGintIisoixfr = bit(20),
                               kGintIisooxfr = bit(21), kGintHprt = bit(24), kGintHc = bit(25),
                               kGintPtxfe = bit(26), kGintCidschg = bit(28), kGintDisc = bit(29),
                               kGintSrq = bit(30), kGintWkup = bit(31);
inline constexpr std::uint32_t kGintEpmismF405 = bit(17), kGintRstdet = bit(23),
                               kGintLpm = bit(27);  ///< RSTDET and LPM: not on the F405

/// GRXSTSR and GRXSTSP.
inline constexpr std::uint32_t kGrxstsEpnum = bits(0, 4), kGrxstsBcnt = bits(4, 11),
                               kGrxstsDpid = bits(15, 2), kGrxstsPktsts = bits(17, 4),
                               kGrxstsFrmnum = bits(21, 4);
inline constexpr std::uint32_t kGrxstsStsphst = bit(27);  ///< not on the F405
inline constexpr unsigned kGrxstsBcntShift = 4, kGrxstsDpidShift = 15, kGrxstsPktstsShift = 17,
                          kGrxstsFrmnumShift = 21;
/// PKTSTS. "Done" words carry no data; a pop raises the endpoint's XFRC or STUP.
inline constexpr std::uint32_t kPacketGlobalOutNak = 1, kPacketOut = 2, kPacketOutDone = 3,
                               kPacketSetupDone = 4, kPacketSetup = 6;
/// DPID.
inline constexpr std::uint32_t kPidData0 = 0, kPidData1 = 2;

/// Start and depth in FIFO words.
inline constexpr std::uint32_t kDieptxfStart = bits(0, 16), kDieptxfDepth = bits(16, 16);
inline constexpr unsigned kDieptxfDepthShift = 16;

inline constexpr std::uint32_t kGccfgPwrdwn = bit(16);  ///< 1: transceiver on
inline constexpr std::uint32_t kGccfgVbusasenF405 = bit(18), kGccfgVbusbsenF405 = bit(19),
                               kGccfgSofoutenF405 = bit(20), kGccfgNovbussensF405 = bit(21);
inline constexpr std::uint32_t kGccfgVbden = bit(21), kGccfgBcden = bit(17), kGccfgDcden = bit(18),
                               kGccfgPden = bit(19), kGccfgSden = bit(20);  ///< not on the F405

inline constexpr std::uint32_t kDcfgDspd = bits(0, 2), kDcfgDspdFullSpeed = 3,
                               kDcfgNzlsohsk = bit(2), kDcfgDad = bits(4, 7),
                               kDcfgPfivl = bits(11, 2);
inline constexpr unsigned kDcfgDadShift = 4;
inline constexpr std::uint32_t kDctlRwusig = bit(0), kDctlSdis = bit(1), kDctlGinsts = bit(2),
                               kDctlGonsts = bit(3), kDctlTctl = bits(4, 3), kDctlSginak = bit(7),
                               kDctlCginak = bit(8), kDctlSgonak = bit(9), kDctlCgonak = bit(10),
                               kDctlPoprgdne = bit(11);
inline constexpr std::uint32_t kDstsSuspsts = bit(0), kDstsEnumspd = bits(1, 2), kDstsEerr = bit(3),
                               kDstsFnsof = bits(8, 14);
inline constexpr unsigned kDstsEnumspdShift = 1, kDstsFnsofShift = 8;
inline constexpr std::uint32_t kEnumspdFullSpeed = 3;

/// DIEPINTx and DIEPMSK; DIEPEMPMSK masks TXFE.
inline constexpr std::uint32_t kDiepXfrc = bit(0), kDiepEpdisd = bit(1), kDiepToc = bit(3),
                               kDiepIttxfe = bit(4), kDiepInepnm = bit(5), kDiepInepne = bit(6),
                               kDiepTxfe = bit(7), kDiepTxfifoudrn = bit(8), kDiepBna = bit(9),
                               kDiepPktdrpsts = bit(11), kDiepNak = bit(13);
/// DOEPINTx and DOEPMSK.
inline constexpr std::uint32_t kDoepXfrc = bit(0), kDoepEpdisd = bit(1), kDoepStup = bit(3),
                               kDoepOtepdis = bit(4), kDoepStsphsrx = bit(5), kDoepB2bstup = bit(6),
                               kDoepOutpkterr = bit(8), kDoepBerr = bit(12), kDoepNak = bit(13);
/// DAINT: IN endpoints from bit 0, OUT endpoints from here.
inline constexpr unsigned kDaintOutShift = 16;

/// DIEPCTLx and DOEPCTLx. MPSIZ is in bytes; for endpoint 0: 0 is 64, 1 is 32, 2 is 16, 3 is 8.
inline constexpr std::uint32_t kEpctlMpsiz = bits(0, 11), kEpctlMpsiz0 = bits(0, 2),
                               kEpctlUsbaep = bit(15), kEpctlDpid = bit(16), kEpctlNaksts = bit(17),
                               kEpctlEptyp = bits(18, 2), kDoepctlSnpm = bit(20),
                               kEpctlStall = bit(21), kDiepctlTxfnum = bits(22, 4),
                               kEpctlCnak = bit(26), kEpctlSnak = bit(27), kEpctlSd0pid = bit(28),
                               kEpctlSd1pid = bit(29), kEpctlEpdis = bit(30), kEpctlEpena = bit(31);
inline constexpr unsigned kEpctlEptypShift = 18, kDiepctlTxfnumShift = 22;
inline constexpr std::uint32_t kTypeIsochronous = 1, kTypeBulk = 2;

/// DIEPTSIZx and DOEPTSIZx: bytes and packets left. Endpoint 0 has fewer bits.
inline constexpr std::uint32_t kTsizXfrsiz = bits(0, 19), kTsizPktcnt = bits(19, 10),
                               kTsizXfrsiz0 = bits(0, 7), kDieptsizPktcnt0 = bits(19, 2),
                               kDieptsizMcnt = bits(29, 2), kDoeptsizPktcnt0 = bit(19),
                               kDoeptsizStupcnt = bits(29, 2);
inline constexpr unsigned kTsizPktcntShift = 19, kDoeptsizStupcntShift = 29;

inline constexpr std::uint32_t kPcgcctlStppclk = bit(0), kPcgcctlGatehclk = bit(1),
                               kPcgcctlPhysusp = bit(4);

}  // namespace verp::hal::stm32::otg_fs
