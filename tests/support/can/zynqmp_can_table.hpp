#pragma once
#include "hal/chip/zynqmp_can/registers.hpp"

namespace verp::hal::zynqmp_can {

/// The model checks every access against it.
struct Register {
  const char* name;
  std::uint32_t offset;
  std::uint32_t readable, writable;  ///< bits
  bool config_only;                  ///< while SRR.CEN is 0
};

inline constexpr std::uint32_t kWord = 0xFFFFFFFFu;
inline constexpr std::uint32_t kAllInterrupts = 0x7FFF;
inline constexpr Register kTable[] = {
    {"SRR", kSrr, 3, 3, false},
    {"MSR", kMsr, 7, 7, true},
    {"BRPR", kBrpr, 0xFF, 0xFF, true},
    {"BTR", kBtr, 0x1FF, 0x1FF, true},
    {"ECR", kEcr, 0xFFFF, 0, false},
    {"ESR", kEsr, 0x1F, 0x1F, false},
    {"SR", kSr, 0x1FFF, 0, false},
    {"ISR", kIsr, kAllInterrupts, 0, false},
    {"IER", kIer, kAllInterrupts, kAllInterrupts, false},
    {"ICR", kIcr, 0, kAllInterrupts, false},
    {"TXFIFO_ID", kTxId, 0, kWord, false},
    {"TXFIFO_DLC", kTxDlc, 0, 0xFu << kDlcShift, false},
    {"TXFIFO_DATA1", kTxData1, 0, kWord, false},
    {"TXFIFO_DATA2", kTxData2, 0, kWord, false},
    {"RXFIFO_ID", kRxId, kWord, 0, false},
    {"RXFIFO_DLC", kRxDlc, kWord, 0, false},
    {"RXFIFO_DATA1", kRxData1, kWord, 0, false},
    {"RXFIFO_DATA2", kRxData2, kWord, 0, false},
    {"AFR", kAfr, 0xF, 0xF, false},
};

}  // namespace verp::hal::zynqmp_can
