#include "common/protocol/canopen/bus_load.hpp"

namespace verp::canopen {
namespace {

class Wire {
 public:
  constexpr void bit(unsigned value) {
    ++bits_;
    crc_ = ((crc_ >> 14 ^ value) & 1u) != 0 ? (crc_ << 1 ^ 0x4599u) & 0x7FFFu : crc_ << 1 & 0x7FFFu;
    run_ = value == last_ ? run_ + 1 : 1;
    last_ = value;
    just_stuffed_ = run_ == 5;
    if (just_stuffed_) {
      ++stuff_;
      last_ = value ^ 1u;
      run_ = 1;
    }
  }
  constexpr void number(std::uint32_t value, unsigned bits) {
    while (bits > 0) bit(value >> --bits & 1u);
  }
  constexpr std::uint16_t crc() const { return static_cast<std::uint16_t>(crc_); }
  constexpr std::uint32_t all() const { return bits_ + stuff_; }
  constexpr bool just_stuffed() const { return just_stuffed_; }

 private:
  std::uint32_t bits_ = 0;
  std::uint32_t stuff_ = 0;
  std::uint32_t crc_ = 0;
  std::uint32_t run_ = 0;
  std::uint32_t last_ = 2;  // neither 0 nor 1
  bool just_stuffed_ = false;
};

// Start of frame to the bits after IDE. `rtr`: the bit of RTR or RRS.
void arbitration(Wire& wire, const Frame& frame, unsigned rtr) {
  wire.bit(0);
  if (frame.extended) {
    wire.number(frame.id >> 18 & 0x7FF, 11);
    wire.number(3, 2);  // SRR, IDE
    wire.number(frame.id & 0x3FFFF, 18);
    wire.bit(rtr);
  } else {
    wire.number(frame.id & 0x7FF, 11);
    wire.bit(rtr);
    wire.bit(0);  // IDE
  }
}
void classic_to_data(Wire& wire, const Frame& frame) {
  arbitration(wire, frame, frame.remote ? 1 : 0);
  wire.number(0, frame.extended ? 2 : 1);  // FDF and r0, dominant; for 11-bit ids IDE came first
  wire.number(frame.size, 4);
  for (unsigned i = 0; !frame.remote && i < frame.size; ++i) wire.number(frame.data[i], 8);
}

}  // namespace

std::uint16_t classic_crc(const Frame& frame) {
  Wire wire;
  classic_to_data(wire, frame);
  return wire.crc();
}

FrameBits exact_bits(const Frame& frame) {
  Wire wire;
  const std::uint32_t end = kFrameEndBits + kIntermissionBits;
  if (!frame.fd) {
    classic_to_data(wire, frame);
    wire.number(wire.crc(), 15);
    return {wire.all() + end, 0};
  }
  arbitration(wire, frame, 0);
  wire.number(2, 2);  // FDF, res
  wire.bit(frame.bit_rate_switch ? 1 : 0);
  const std::uint32_t slow = wire.all();
  wire.bit(0);  // ESI
  const std::uint8_t size = can_fd_size(frame.size);
  wire.number(can_length_code(size), 4);
  for (unsigned i = 0; i < size; ++i) wire.number(i < frame.size ? frame.data[i] : 0u, 8);
  // A stuff bit after the last data bit is the CRC field's fixed one.
  const std::uint32_t data = wire.all() - slow - (wire.just_stuffed() ? 1 : 0);
  const std::uint32_t fast = data + (size > 16 ? 4u + 21u + 7u : 4u + 17u + 6u);
  return frame.bit_rate_switch ? FrameBits{slow + end, fast} : FrameBits{slow + fast + end, 0};
}

}  // namespace verp::canopen
