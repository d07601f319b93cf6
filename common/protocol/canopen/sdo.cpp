#include "common/protocol/canopen/sdo.hpp"

namespace verp::canopen::sdo {
namespace {

struct NibbleTable {
  std::uint16_t of[16];
};

// Remainder of four leading bits under the polynomial 1021h.
constexpr NibbleTable nibble_table() {
  NibbleTable table{};
  for (unsigned nibble = 0; nibble < 16; ++nibble) {
    unsigned crc = nibble << 12;
    for (int bit = 0; bit < 4; ++bit) crc = crc & 0x8000 ? crc << 1 ^ 0x1021 : crc << 1;
    table.of[nibble] = static_cast<std::uint16_t>(crc);
  }
  return table;
}
constexpr NibbleTable kNibbles = nibble_table();

}  // namespace

std::uint16_t crc16(const std::uint8_t* data, std::size_t size, std::uint16_t crc) {
  unsigned sum = crc;
  for (std::size_t i = 0; i < size; ++i) {
    sum = (sum << 4 ^ kNibbles.of[(sum >> 12 ^ data[i] >> 4) & 15]) & 0xFFFF;
    sum = (sum << 4 ^ kNibbles.of[(sum >> 12 ^ data[i]) & 15]) & 0xFFFF;
  }
  return static_cast<std::uint16_t>(sum);
}

}  // namespace verp::canopen::sdo
