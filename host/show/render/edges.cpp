#include "host/show/render/edges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace verp::render {
namespace {

constexpr int kReach_px = 12;
constexpr int kLeastJump = 10;  ///< of 255
constexpr int kLeastPart = 10;  ///< of the brighter value

class Smoother {
 public:
  explicit Smoother(Image& image)
      : image_(image), from_(image.rgb), width_(image.size.width), luma_(from_.size() / 3) {
    constexpr int kRed = 54, kGreen = 183, kBlue = 19;  // of 256: ITU-R BT.709
    for (std::size_t i = 0; i < luma_.size(); ++i) {
      const std::uint8_t* rgb = &from_[3 * i];
      luma_[i] = (kRed * rgb[0] + kGreen * rgb[1] + kBlue * rgb[2]) >> 8;
    }
  }

  void run() {
    for (int y = 1; y + 1 < image_.size.height; ++y) {
      for (int x = 1; x + 1 < width_; ++x) smooth(x, y);
    }
  }

 private:
  int luma(int at) const { return luma_[static_cast<std::size_t>(at)]; }

  /// Curvature of brightness along `step`, here and in two neighbours.
  int bend(int at, int step, int beside) const {
    const auto one = [&](int i) { return std::abs(luma(i - step) - 2 * luma(i) + luma(i + step)); };
    return 2 * one(at) + one(at - beside) + one(at + beside);
  }

  void smooth(int x, int y) {
    const int at = y * width_ + x, here = luma(at);
    const int left = luma(at - 1), right = luma(at + 1), above = luma(at - width_),
              below = luma(at + width_);
    const int low = std::min(std::min(std::min(left, right), std::min(above, below)), here),
              high = std::max(std::max(std::max(left, right), std::max(above, below)), here);
    if (high - low < kLeastJump || kLeastPart * (high - low) < high) return;
    const bool level = bend(at, width_, 1) >= bend(at, 1, width_);
    const int along = level ? 1 : width_, across = level ? width_ : 1;
    const int back = luma(at - across) - here, ahead = luma(at + across) - here;
    const int other = std::abs(back) >= std::abs(ahead) ? at - across : at + across;
    const int room[] = {level ? x : y, (level ? width_ : image_.size.height) - 1 - (level ? x : y)};
    const float share = hidden(at, other, along, room);
    if (share > 0) mix(at, other, share);
  }

  /// Share of a pixel behind its edge to `other`.
  float hidden(int at, int other, int along, const int (&room)[2]) const {
    const int jump = luma(other) - luma(at), middle = luma(at) + luma(other);
    int steps[2], change[2];
    for (const int side : {0, 1}) {
      const int most = std::min(kReach_px, room[side]), step = side == 0 ? -along : along;
      int& i = steps[side] = 0;
      do {
        ++i;
        change[side] = luma(at + i * step) + luma(other + i * step) - middle;
      } while (i < most && 2 * std::abs(change[side]) < std::abs(jump));
      if (2 * std::abs(change[side]) < std::abs(jump)) change[side] = 0;
    }
    const int nearer = steps[0] <= steps[1] ? 0 : 1;
    // At the nearer end this side must change toward the other, else the stairs run elsewhere.
    if (change[nearer] == 0 || (change[nearer] > 0) != (jump > 0)) return 0;
    const auto run = static_cast<float>(steps[0] + steps[1] - 1);
    return 0.5F - (static_cast<float>(steps[nearer]) - 0.5F) / run;
  }

  void mix(int at, int other, float share) {
    for (int i = 0; i < 3; ++i) {
      const auto to = static_cast<std::size_t>(3 * at + i),
                 by = static_cast<std::size_t>(3 * other + i);
      const auto value = static_cast<float>(from_[to]), behind = static_cast<float>(from_[by]);
      image_.rgb[to] = static_cast<std::uint8_t>(value + share * (behind - value) + 0.5F);
    }
  }

  Image& image_;
  const std::vector<std::uint8_t> from_;
  const int width_;
  std::vector<int> luma_;
};

}  // namespace

void smooth_edges(Image& image) {
  if (image.size.width < 3 || image.size.height < 3) return;
  Smoother(image).run();
}

}  // namespace verp::render
