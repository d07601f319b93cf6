#pragma once
#include <cstdint>

/// 32-bit registers (AMD UG1087, module CAN; UG1085, chapter 20).
namespace verp::hal::zynqmp_can {

inline constexpr std::uint32_t kSrr = 0x00;   ///< reset and enable
inline constexpr std::uint32_t kMsr = 0x04;   ///< mode
inline constexpr std::uint32_t kBrpr = 0x08;  ///< prescaler minus 1
inline constexpr std::uint32_t kBtr = 0x0C;   ///< segments minus 1
inline constexpr std::uint32_t kEcr = 0x10;   ///< error counters
inline constexpr std::uint32_t kEsr = 0x14;   ///< error kinds seen; write 1 clears
inline constexpr std::uint32_t kSr = 0x18;    ///< status
inline constexpr std::uint32_t kIsr = 0x1C;   ///< interrupt status
inline constexpr std::uint32_t kIer = 0x20;   ///< interrupt enable
inline constexpr std::uint32_t kIcr = 0x24;   ///< clears bits of kIsr
inline constexpr std::uint32_t kTxId = 0x30;  ///< transmit FIFO; writing kTxData2 sends
inline constexpr std::uint32_t kTxDlc = 0x34;
inline constexpr std::uint32_t kTxData1 = 0x38;
inline constexpr std::uint32_t kTxData2 = 0x3C;
inline constexpr std::uint32_t kRxId = 0x50;  ///< receive FIFO, read in this order
inline constexpr std::uint32_t kRxDlc = 0x54;
inline constexpr std::uint32_t kRxData1 = 0x58;
inline constexpr std::uint32_t kRxData2 = 0x5C;
inline constexpr std::uint32_t kAfr = 0x60;  ///< acceptance filters; 0: accept all

inline constexpr std::uint32_t kSrrReset = 1u << 0;
inline constexpr std::uint32_t kSrrEnable = 1u << 1;
inline constexpr std::uint32_t kSrConfig = 1u << 0;
inline constexpr std::uint32_t kSrNormal = 1u << 3;
inline constexpr std::uint32_t kSrBusOff = 2u << 7;     ///< of kSrState
inline constexpr std::uint32_t kIsrSent = 1u << 1;      ///< TXOK
inline constexpr std::uint32_t kIsrReceived = 1u << 4;  ///< RXOK
inline constexpr std::uint32_t kIsrOverrun = 1u << 6;   ///< RXOFLW
inline constexpr std::uint32_t kIsrNotEmpty = 1u << 7;  ///< RXNEMP
inline constexpr std::uint32_t kIsrError = 1u << 8;
inline constexpr std::uint32_t kIsrBusOff = 1u << 9;

inline constexpr unsigned kBtrAfterShift = 4;  ///< TS2
inline constexpr unsigned kBtrJumpShift = 7;   ///< SJW
// 11 bits from bit 21, then these flags, 18 more bits from bit 1.
inline constexpr std::uint32_t kIdRemote = 1u << 20;  ///< SRR in an extended frame
inline constexpr std::uint32_t kIdExtended = 1u << 19;
inline constexpr std::uint32_t kIdRemoteExtended = 1u << 0;
inline constexpr unsigned kDlcShift = 28;
inline constexpr std::uint32_t kMostPrescaler = 256;
inline constexpr std::uint32_t kFifoFrames = 64;  ///< each way

}  // namespace verp::hal::zynqmp_can
