#pragma once
#include <cstdint>

/// Byte registers of the SJA1000 in PeliCAN mode (NXP data sheet, 4 January 2000, by section).
namespace verp::hal::sja1000 {

inline constexpr std::uint32_t kMod = 0;          ///< 6.4.3 mode
inline constexpr std::uint32_t kCmr = 1;          ///< 6.4.4 command, write only
inline constexpr std::uint32_t kSr = 2;           ///< 6.4.5 status, read only
inline constexpr std::uint32_t kIr = 3;           ///< 6.4.6 interrupts; a read clears all but RI
inline constexpr std::uint32_t kIer = 4;          ///< 6.4.7 interrupt enable
inline constexpr std::uint32_t kBtr0 = 6;         ///< 6.5.1 bit timing
inline constexpr std::uint32_t kBtr1 = 7;         ///< 6.5.2
inline constexpr std::uint32_t kOcr = 8;          ///< 6.5.3 output control
inline constexpr std::uint32_t kAlc = 11;         ///< 6.4.8 arbitration lost capture
inline constexpr std::uint32_t kEcc = 12;         ///< 6.4.9 error code capture; a read re-arms it
inline constexpr std::uint32_t kTxErr = 15;       ///< 6.4.12
inline constexpr std::uint32_t kBuffer = 16;      ///< 6.4.13 write: transmit, 6.4.14 read: receive
inline constexpr std::uint32_t kAcceptance = 16;  ///< 6.4.15 codes 0 to 3 (reset mode)
inline constexpr std::uint32_t kMask = 20;        ///< 6.4.15 masks; 1: ignore the bit
inline constexpr std::uint32_t kRmc = 29;         ///< 6.4.16 received messages
inline constexpr std::uint32_t kCdr = 31;         ///< 6.5.4 clock divider and mode

// MOD. AFM 0: two short filters. QEMU 7.2's single filter refuses 0x1FF even with an open mask.
inline constexpr std::uint8_t kModReset = 1u << 0;
inline constexpr std::uint8_t kModSingleFilter = 1u << 3;
// CMR
inline constexpr std::uint8_t kCmrTransmit = 1u << 0;
inline constexpr std::uint8_t kCmrAbort = 1u << 1;
inline constexpr std::uint8_t kCmrRelease = 1u << 2;
inline constexpr std::uint8_t kCmrClearOverrun = 1u << 3;
// SR
inline constexpr std::uint8_t kSrReceived = 1u << 0;
inline constexpr std::uint8_t kSrOverrun = 1u << 1;
inline constexpr std::uint8_t kSrBufferFree = 1u << 2;
inline constexpr std::uint8_t kSrComplete = 1u << 3;
inline constexpr std::uint8_t kSrErrors = 1u << 6;
inline constexpr std::uint8_t kSrBusOff = 1u << 7;
inline constexpr std::uint8_t kIrReceive = 1u << 0;
inline constexpr std::uint8_t kIrTransmit = 1u << 1;
inline constexpr std::uint8_t kIrWarning = 1u << 2;  ///< error or bus status changed
inline constexpr std::uint8_t kIrOverrun = 1u << 3;
inline constexpr std::uint8_t kIrBusError = 1u << 7;
// OCR: normal mode, both outputs push-pull.
inline constexpr std::uint8_t kOcrPushPull = 0x1A;
// CDR: PeliCAN, no input comparator, no clock output.
inline constexpr std::uint8_t kCdrPeliCan = 1u << 7;
inline constexpr std::uint8_t kCdrBypass = 1u << 6;
inline constexpr std::uint8_t kCdrClockOff = 1u << 3;
inline constexpr std::uint8_t kFrameExtended = 1u << 7;
inline constexpr std::uint8_t kFrameRemote = 1u << 6;
inline constexpr std::uint8_t kFrameLength = 0x0F;

inline constexpr std::uint32_t kFifoBytes = 64;        ///< 6.4.14: for all received frames
inline constexpr std::uint32_t kClockDivider = 2;      ///< 6.5.1: quanta of half the crystal
inline constexpr std::uint32_t kMostPrescaler = 64;    ///< BTR0.BRP
inline constexpr std::uint32_t kShortHeaderBytes = 3;  ///< standard frame, in the FIFO
inline constexpr std::uint32_t kLongHeaderBytes = 5;

}  // namespace verp::hal::sja1000
