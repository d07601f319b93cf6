#pragma once
#include "hal/chip/sja1000/registers.hpp"

namespace verp::hal::sja1000 {

/// The model checks every access against it.
struct Register {
  const char* name;
  std::uint32_t offset;
  bool read, write;     ///< in operating mode
  bool write_in_reset;  ///< in reset mode
};

inline constexpr Register kTable[] = {
    {"MOD", kMod, true, true, true},
    {"CMR", kCmr, false, true, true},
    {"SR", kSr, true, false, false},
    {"IR", kIr, true, false, false},
    {"IER", kIer, true, true, true},
    {"BTR0", kBtr0, true, false, true},
    {"BTR1", kBtr1, true, false, true},
    {"OCR", kOcr, true, false, true},
    {"ALC", kAlc, true, false, false},
    {"ECC", kEcc, true, false, false},
    {"TXERR", kTxErr, true, false, true},
    {"BUF0", kBuffer, true, true, true},
    {"BUF1", kBuffer + 1, true, true, true},
    {"BUF2", kBuffer + 2, true, true, true},
    {"BUF3", kBuffer + 3, true, true, true},
    {"BUF4", kBuffer + 4, true, true, true},
    {"BUF5", kBuffer + 5, true, true, true},
    {"BUF6", kBuffer + 6, true, true, true},
    {"BUF7", kBuffer + 7, true, true, true},
    {"BUF8", kBuffer + 8, true, true, false},
    {"BUF9", kBuffer + 9, true, true, false},
    {"BUF10", kBuffer + 10, true, true, false},
    {"BUF11", kBuffer + 11, true, true, false},
    {"BUF12", kBuffer + 12, true, true, false},
    {"RMC", kRmc, true, false, false},
    {"CDR", kCdr, true, true, true},
};

}  // namespace verp::hal::sja1000
