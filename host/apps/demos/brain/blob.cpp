#include "host/apps/demos/brain/blob.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace verp::brain {
namespace {

constexpr int kFewest = 8;  // pixels

/// Orange, bright or in shade, has much more red than green and more green than blue.
bool is_orange(const unsigned char* pixel) {
  const int red = pixel[0], green = pixel[1], blue = pixel[2];
  return red > 70 && 10 * red > 14 * green && 10 * green > 15 * blue;
}

}  // namespace

std::optional<Blob> orange_blob(const Picture& picture) {
  const int width = picture.width_px, height = picture.height_px;
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (size == 0 || picture.rgb.size() < 3 * size) return std::nullopt;
  const auto* pixels = reinterpret_cast<const unsigned char*>(picture.rgb.data());
  std::vector<char> left(size);
  for (std::size_t i = 0; i < size; ++i) left[i] = is_orange(pixels + 3 * i);
  Blob best;
  std::vector<int> open;
  for (int first = 0; first < width * height; ++first) {
    if (left[static_cast<std::size_t>(first)] == 0) continue;
    Blob blob;
    left[static_cast<std::size_t>(first)] = 0;
    open.assign(1, first);
    while (!open.empty()) {  // flood fill
      const int at = open.back();
      open.pop_back();
      const int u = at % width, v = at / width;
      blob.u_px += u;
      blob.v_px += v;
      ++blob.pixels;
      const auto take = [&](int next, bool inside) {
        if (!inside || left[static_cast<std::size_t>(next)] == 0) return;
        left[static_cast<std::size_t>(next)] = 0;
        open.push_back(next);
      };
      take(at - 1, u > 0);
      take(at + 1, u + 1 < width);
      take(at - width, v > 0);
      take(at + width, v + 1 < height);
    }
    if (blob.pixels > best.pixels) best = blob;
  }
  if (best.pixels < kFewest) return std::nullopt;
  best.u_px /= best.pixels;
  best.v_px /= best.pixels;
  best.wide_px = 2 * std::sqrt(best.pixels / std::numbers::pi);
  return best;
}

std::optional<Point> on_floor(const About& about, const Picture& picture, double u_px, double v_px,
                              double high_m) {
  const double ray[3] = {1, (about.cx_px - u_px) / about.fx_px, (about.cy_px - v_px) / about.fy_px};
  double level[3] = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      level[row] += picture.camera_axes[3 * row + column] * ray[column];
  }
  constexpr double kFlattest = 0.02;  // a nearly level ray gives no distance
  if (level[2] > -kFlattest) return std::nullopt;
  const double far = (picture.camera_m[2] - high_m) / -level[2];
  return out_of(picture.odometry,
                Point{picture.camera_m[0] + far * level[0], picture.camera_m[1] + far * level[1]});
}

}  // namespace verp::brain
