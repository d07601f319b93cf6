#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/show/render/edges.hpp"
#include "host/show/render/offscreen_context.hpp"
#include "host/show/render/renderer.hpp"
#include "host/show/scene/build.hpp"

namespace verp::render {
namespace {

/// Tilted; dark left, bright right; each pixel is the mean of n x n samples.
Image line(double angle_rad, double shift_px, int n) {
  constexpr int kWidth = 64, kHeight = 48, kDark = 40, kBright = 200;
  Image image{{kWidth, kHeight}, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      int bright = 0;
      for (int i = 0; i < n * n; ++i) {
        const double u = x + (i % n + 0.5) / n - kWidth / 2.0 - shift_px,
                     v = y + (i / n + 0.5) / n - kHeight / 2.0;
        bright += u * std::cos(angle_rad) + v * std::sin(angle_rad) > 0 ? 1 : 0;
      }
      const auto value = static_cast<std::uint8_t>(kDark + (kBright - kDark) * bright / (n * n));
      image.rgb.insert(image.rgb.end(), {value, value, value});
    }
  }
  return image;
}

double apart(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::pow(a.rgb[i] - b.rgb[i], 2);
  return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

TEST(SmoothedEdges, AreNearerToTheTruthThanStairs) {
  std::mt19937 random(2001);
  std::uniform_real_distribution<double> any(0, 1);
  double stairs = 0, smoothed = 0;
  for (int i = 0; i < 60; ++i) {
    const double angle_rad = 2 * M_PI * any(random), shift_px = any(random);
    const Image truth = line(angle_rad, shift_px, 8);
    Image image = line(angle_rad, shift_px, 1);
    stairs += apart(image, truth);
    smooth_edges(image);
    smoothed += apart(image, truth);
  }
  EXPECT_LT(smoothed, 0.6 * stairs) << smoothed / stairs;
}

TEST(SmoothedEdges, LeaveWhatIsEvenAndWhatIsLevelAlone) {
  for (const double angle_rad : {0.0, M_PI / 2}) {
    const Image before = line(angle_rad, 0, 1);
    Image after = before;
    smooth_edges(after);
    EXPECT_EQ(after.rgb, before.rgb);
  }
  for (const Size size : {Size{1, 1}, Size{2, 40}, Size{40, 2}, Size{3, 3}}) {
    Image image{size, std::vector<std::uint8_t>(
                          static_cast<std::size_t>(3 * size.width * size.height), 90)};
    smooth_edges(image);
    EXPECT_EQ(image.rgb, std::vector<std::uint8_t>(image.rgb.size(), 90));
  }
}

TEST(LeftOutOfAPicture, IsNothingOfWhichAPixelIsToBeSeen) {
  OffscreenContext context;
  Renderer renderer;
  scene::Scene scene = scene::studio();
  scene.ground.on = false;
  scene.items.resize(1);
  scene::Item& ball = scene.items[0];
  ball = {};
  ball.name = "ball";
  ball.node = scene::kWorld;
  ball.shape = scene::Shape::kSphere;
  scene::Camera camera;
  camera.eye_m = {0.3, -0.2, 0.5};
  camera.target_m = {1, 0.4, 0.3};
  camera.vertical_fov_rad = 0.9;
  camera.near_m = 0.02;
  camera.far_m = 50;
  const Size size{64, 48};
  const double half = std::tan(camera.vertical_fov_rad / 2);
  const scene::Vec3 ahead = (camera.target_m - camera.eye_m).normalized(),
                    right = ahead.cross(scene::Vec3::UnitZ()).normalized(), up = right.cross(ahead);
  std::mt19937 random(2002);
  std::normal_distribution<double> any;
  int seen = 0, at_the_rim = 0;
  for (int i = 0; i < 400; ++i) {
    ball.size_m.x() = 0.15 * std::exp(any(random));
    const scene::Vec3 at = scene::Vec3(any(random), any(random), any(random));
    if (at.norm() < ball.size_m.x() + 0.1) continue;
    ball.pose.translation() = camera.eye_m + at;
    // The drawn ball has flat faces; 0.97 of its radius fits inside.
    const double cosine = std::cos(std::asin(0.97 * ball.size_m.x() / at.norm()));
    int met = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const scene::Vec3 ray =
            ahead + right * ((2 * (x + 0.5) / size.width - 1) * half * size.width / size.height) +
            up * ((1 - 2 * (y + 0.5) / size.height) * half);
        met += ray.normalized().dot(at.normalized()) > cosine ? 1 : 0;
      }
    }
    renderer.set_scene(scene);
    const Measured picture = renderer.measure({}, camera, size);
    const auto drawn = std::count_if(picture.label.begin(), picture.label.end(),
                                     [](std::uint16_t label) { return label != 0; });
    if (met == 0) continue;
    EXPECT_GE(drawn, met) << ball.size_m.x() << " at " << at.transpose();
    ++seen;
    const bool middle_outside = at.dot(ahead) < 0 || std::abs(at.dot(up)) > half * at.dot(ahead);
    at_the_rim += middle_outside ? 1 : 0;
  }
  EXPECT_GT(seen, 20);
  EXPECT_GT(at_the_rim, 3);
}

}  // namespace
}  // namespace verp::render
