#pragma once
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "hal/chip/stm32/registers/can.hpp"

/// Frame layout in bxCAN's mailboxes and FIFOs.
namespace verp::hal::stm32 {

struct CanMailbox {
  CanFrame frame;
  bool busy = false;
  bool aborted = false;  ///< abort requested, maybe too late
  bool dropped = false;  ///< no longer needed
};

constexpr std::uint32_t can_identifier(std::uint32_t id, bool extended, bool remote) {
  return (extended ? id << can::kIrExidShift | can::kIrIde : id << can::kIrStidShift) |
         (remote ? can::kIrRtr : 0);
}

/// Four data bytes from byte `from` on.
constexpr std::uint32_t can_data_word(const CanFrame& frame, unsigned from) {
  std::uint32_t word = 0;
  for (unsigned i = 0; i < 4; ++i) word |= std::uint32_t{frame.data[from + i]} << 8 * i;
  return word;
}

/// A frame as RIR, RDTR, RDLR and RDHR hold it.
struct CanReceived {
  std::uint32_t identifier, length, low, high;

  constexpr CanFrame frame() const {
    CanFrame frame;
    frame.extended = (identifier & can::kIrIde) != 0;
    frame.remote = (identifier & can::kIrRtr) != 0;
    frame.id = identifier >> (frame.extended ? can::kIrExidShift : can::kIrStidShift);
    const std::uint32_t code = length & can::kDtrDlc;  // 9 to 15 mean 8 (ISO 11898-1)
    frame.size = static_cast<std::uint8_t>(code < kMaxCanData ? code : kMaxCanData);
    for (unsigned i = 0; i < frame.size && !frame.remote; ++i) {
      frame.data[i] = static_cast<std::uint8_t>((i < 4 ? low : high) >> 8 * (i % 4));
    }
    return frame;
  }
};

/// Time on the wire without stuff bits.
constexpr std::uint32_t can_frame_us(const CanFrame& frame, std::uint32_t bitrate) {
  const std::uint32_t bits = (frame.extended ? 64u : 44u) + (frame.remote ? 0u : 8u * frame.size);
  return bits * 1000 / (bitrate / 1000);
}

}  // namespace verp::hal::stm32
