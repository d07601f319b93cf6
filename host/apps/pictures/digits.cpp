#include "host/apps/pictures/digits.hpp"

#include <string>

namespace verp::pictures {
namespace {

constexpr int kRows = 7, kColumns = 5;
/// One number a row; the leftmost dot is the highest bit.
constexpr std::uint8_t kDigits[10][kRows] = {
    {0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E}, {0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E},
    {0x0E, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1F}, {0x1F, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0E},
    {0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02}, {0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E},
    {0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E}, {0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08},
    {0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E}, {0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C}};

void fill(render::Image& image, int left, int top, int size) {
  for (int y = top; y < top + size && y < image.size.height; ++y) {
    for (int x = left; x < left + size && x < image.size.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.rgb[static_cast<std::size_t>(3 * (y * image.size.width + x) + c)] = 70;
      }
    }
  }
}

}  // namespace

void write_number(render::Image& image, int number, int scale) {
  int left = 4 * scale;
  for (const char digit : std::to_string(number)) {
    if (digit < '0' || digit > '9') continue;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        if ((kDigits[digit - '0'][row] >> (kColumns - 1 - column) & 1) == 0) continue;
        fill(image, left + column * scale, (4 + row) * scale, scale);
      }
    }
    left += (kColumns + 1) * scale;
  }
}

}  // namespace verp::pictures
