#include "host/apps/pictures/studio.hpp"

#include <algorithm>
#include <cmath>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/pictures/digits.hpp"

namespace verp::pictures {
namespace {

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
