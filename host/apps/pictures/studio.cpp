#include "host/apps/pictures/studio.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::pictures {
namespace {

constexpr int kDigitRows = 7, kDigitColumns = 5;
/// One number a row; the leftmost dot is the highest bit.
constexpr std::uint8_t kDigits[10][kDigitRows] = {
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

/// Upper left corner; a dot is `scale` pixels.
void write_number(render::Image& image, int number, int scale) {
  int left = 4 * scale;
  for (const char digit : std::to_string(number)) {
    if (digit < '0' || digit > '9') continue;
    for (int row = 0; row < kDigitRows; ++row) {
      for (int column = 0; column < kDigitColumns; ++column) {
        if ((kDigits[digit - '0'][row] >> (kDigitColumns - 1 - column) & 1) == 0) continue;
        fill(image, left + column * scale, (4 + row) * scale, scale);
      }
    }
    left += (kDigitColumns + 1) * scale;
  }
}

void paste(render::Image& onto, const render::Image& part, int left, int top) {
  const auto row = static_cast<std::ptrdiff_t>(3 * part.size.width);
  for (int y = 0; y < part.size.height; ++y) {
    const auto from = part.rgb.begin() + y * row;
    std::copy(
        from, from + row,
        onto.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * onto.size.width + left));
  }
}

}  // namespace

Studio::Studio(const Film& film) {
  try {
    context_ = std::make_unique<render::OffscreenContext>();
    renderer_ = std::make_unique<render::Renderer>();
  } catch (const render::RenderError& error) {
    throw cli::ToolError(cli::kNoDevice, error.what());
  }
  renderer_->set_scene(film.scene());
  if (!film.note().empty()) cli::complain(film.note());
  for (const std::string& note : renderer_->notes()) cli::complain(note);
}

render::Image Studio::filmstrip(const std::vector<scene::Snapshot>& states, render::Size size,
                                const CameraOf& camera, const render::Effects& effects) {
  constexpr int kColumns = 8;
  const int rows = (static_cast<int>(states.size()) + kColumns - 1) / kColumns;
  const render::Size one{size.width / kColumns, size.height / rows};
  render::Image strip{size, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(size.width) *
                                                          static_cast<std::size_t>(size.height),
                                                      255)};
  for (int i = 0; i < static_cast<int>(states.size()); ++i) {
    const scene::Snapshot& now = states[static_cast<std::size_t>(i)];
    render::Image picture = renderer_->image(now, camera(now, one), one, effects);
    write_number(picture, i, std::max(1, one.height / 160));
    paste(strip, picture, i % kColumns * one.width, i / kColumns * one.height);
  }
  return strip;
}

std::array<std::uint8_t, 3> colour_of(int label) {
  if (label == 0) return {0, 0, 0};
  std::array<std::uint8_t, 3> rgb{};
  const double hue = 6 * std::fmod(0.618034 * label, 1.0), value = label % 2 == 0 ? 235 : 180;
  for (int i = 0; i < 3; ++i) {
    const double k = std::fmod(5 - 2 * i + hue, 6.0);
    const double part = 1 - 0.75 * std::max(0.0, std::min({k, 4 - k, 1.0}));
    rgb[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(value * part));
  }
  return rgb;
}

render::Image coloured(const render::Measured& measured) {
  render::Image image{measured.size, {}};
  for (const std::uint16_t label : measured.label) {
    const auto rgb = colour_of(label);
    image.rgb.insert(image.rgb.end(), rgb.begin(), rgb.end());
  }
  return image;
}

}  // namespace verp::pictures
