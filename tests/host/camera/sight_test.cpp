#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <tuple>

#include "host/robot/model/lens.hpp"
#include "host/robot/model/load.hpp"
#include "host/show/camera/program/drawer.hpp"
#include "host/show/render/files.hpp"
#include "host/show/scene/build.hpp"
#include "tests/host/camera/files.hpp"

namespace verp::camera::test {
namespace {

constexpr const char* kSkew =
    "<lens><intrinsics><fx>260</fx><fy>280</fy><cx>150</cx><cy>125</cy><s>0</s></intrinsics></"
    "lens>";
constexpr const char* kBarrel =
    "<distortion><k1>-0.25</k1><k2>0.08</k2><k3>0</k3><p1>0.002</p1><p2>-0.003</p2></distortion>";

struct Sight {
  Files files;
  model::Entity robot;
  model::CameraSensor camera;
  Moment moment;
  std::vector<Picture> pictures;

  Sight(const std::string& type, const std::string& inner, const std::string& ball,
        std::uint64_t time_us = 1000, std::uint64_t seed = 1) {
    const std::string file = files.robot(type, inner);
    robot = model::load_robot(file);
    camera = robot.cameras.at(0);
    moment = {.time_us = time_us,
              .cameras = {0},
              .link_world = {scene::standing(robot).link_world},
              .body_world = {}};
    Drawer drawer({.robots = {{file, seed}}, .world_file = files.world(ball)});
    pictures = drawer.draw(moment, 0);
  }

  model::Transform link() const {
    return moment.link_world[0][static_cast<std::size_t>(camera.node)];
  }
  std::uint16_t value(int x, int y) const {
    std::uint16_t value = 0;
    std::memcpy(&value,
                pictures.back().data.data() +
                    2 * (static_cast<std::size_t>(y) * 320 + static_cast<std::size_t>(x)),
                2);
    return value;
  }
};

Eigen::Vector2d red_middle(const render::Image& image) {
  Eigen::Vector2d sum(0, 0);
  int count = 0;
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const std::uint8_t* rgb =
          image.rgb.data() +
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.size.width) +
               static_cast<std::size_t>(x));
      if (rgb[0] < 60 || rgb[0] < 2 * rgb[1] || rgb[0] < 2 * rgb[2]) continue;
      sum += Eigen::Vector2d(x, y);
      ++count;
    }
  }
  EXPECT_GT(count, 100);
  return sum / count;
}

/// By solid angle. Off the axis the ball's outline is an oval with another centre.
Eigen::Vector2d outline_middle(const model::CameraSensor& camera, const model::Vec3& ball_lens_m) {
  constexpr double kRadius_m = 0.05;
  const double distance_m = ball_lens_m.norm();
  const double cosine = std::cos(std::asin(kRadius_m / distance_m));
  Eigen::Vector2d sum(0, 0);
  int count = 0;
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const auto direction = model::direction_of(camera, {x, y});
      const model::Vec3 ray = model::Vec3(direction->x(), direction->y(), 1).normalized();
      if (ray.dot(ball_lens_m) / distance_m < cosine) continue;
      sum += Eigen::Vector2d(x, y);
      ++count;
    }
  }
  return sum / count;
}

TEST(Sight, ABallIsInThePictureWhereTheLensHasIt) {
  for (const auto& [lens, ball] : {std::tuple{"", "0.8 0 0.4"},
                                   {"", "0.7 0.25 0.55"},
                                   {kSkew, "0.7 -0.2 0.3"},
                                   {kBarrel, "0.6 0.24 0.24"}}) {
    const Sight sight("camera", lens, ball);
    ASSERT_EQ(sight.pictures.size(), 1u);
    const render::Image image = render::read_png("picture", sight.pictures[0].data);
    ASSERT_EQ(image.size.width, 320);
    ASSERT_EQ(image.size.height, 240);
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(ball, "%lf %lf %lf", &x, &y, &z), 3);
    const model::Vec3 in_lens =
        model::in_lens(sight.camera, sight.link().inverse() * model::Vec3(x, y, z));
    const Eigen::Vector2d expected = outline_middle(sight.camera, in_lens);
    // Within two pixels by the lens' own formula.
    EXPECT_LT((expected - model::pixel_of(sight.camera, in_lens.head<2>() / in_lens.z())).norm(), 2)
        << lens << ball;
    EXPECT_LT((red_middle(image) - expected).norm(), 1) << lens << ball;
  }
}

TEST(Sight, DepthIsThatOfTheFloorToItsMillimetre) {
  for (const char* lens : {"", kBarrel}) {
    const Sight sight("depth_camera", lens, "0 5 0.1");
    ASSERT_EQ(sight.pictures.size(), 1u);
    EXPECT_EQ(sight.pictures[0].encoding, "16UC1");
    const model::Transform eye = sight.link() * sight.camera.pose;
    int compared = 0;
    for (int y = 160; y < 236; y += 15) {
      for (int x = 20; x < 300; x += 40) {
        const auto direction = model::direction_of(sight.camera, {x, y});
        const model::Vec3 ray = eye.linear() * model::Vec3(1, -direction->x(), -direction->y());
        const double depth_m = -eye.translation().z() / ray.z();
        if (depth_m > 3) continue;
        // Per pixel downwards; a lens takes the nearest drawn pixel.
        const double slope_m = depth_m * depth_m / (sight.camera.fy_px * eye.translation().z());
        EXPECT_NEAR(sight.value(x, y), 1000 * depth_m, 1 + (*lens == 0 ? 0 : 600 * slope_m))
            << x << ' ' << y << lens;
        ++compared;
      }
    }
    EXPECT_GT(compared, 20);
    EXPECT_EQ(sight.value(160, 2), 0) << "the sky is no depth";
  }
}

TEST(Sight, LabelsAreOfLinksAndThings) {
  const Sight sight("segmentation_camera", "", "0.8 0 0.4");
  ASSERT_EQ(sight.pictures.size(), 1u);
  EXPECT_EQ(sight.pictures[0].encoding, "mono16");
  const model::Vec3 ball =
      model::in_lens(sight.camera, sight.link().inverse() * model::Vec3(0.8, 0, 0.4));
  const Eigen::Vector2d at = model::pixel_of(sight.camera, ball.head<2>() / ball.z());
  const int label = sight.value(static_cast<int>(at.x()), static_cast<int>(at.y()));
  EXPECT_GT(label, 0);
  EXPECT_EQ(sight.value(5, 5), 0);
  const std::vector<std::string>& names = sight.pictures[0].names;
  ASSERT_LE(label, static_cast<int>(names.size()));
  EXPECT_EQ(names[static_cast<std::size_t>(label - 1)], "ball");
  const auto sent = unpack_picture(pack(sight.pictures[0]));
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->names, names);
}

TEST(Sight, ColourAndDepthComeTogether) {
  const Sight sight("rgbd_camera", "", "0.8 0 0.4");
  ASSERT_EQ(sight.pictures.size(), 2u);
  EXPECT_EQ(sight.pictures[0].encoding, "png");
  EXPECT_EQ(sight.pictures[1].encoding, "16UC1");
}

double apart(const render::Image& a, const render::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

TEST(Sight, NoiseIsAsTheFileSaysAndOfTheSeedAndTheTimeAlone) {
  const std::string noise =
      "<noise><type>gaussian</type><mean>0</mean><stddev>0.02</stddev></noise>";
  const auto image = [](const Sight& sight) {
    return render::read_png("picture", sight.pictures[0].data);
  };
  const render::Image clean = image(Sight("camera", "", "0.8 0 0.4"));
  const render::Image noisy = image(Sight("camera", noise, "0.8 0 0.4"));
  // A normal distribution's mean deviation; white and black clip some.
  EXPECT_NEAR(apart(clean, noisy), 0.798 * 255 * 0.02, 0.5);
  EXPECT_EQ(noisy.rgb, image(Sight("camera", noise, "0.8 0 0.4")).rgb);
  EXPECT_GT(apart(noisy, image(Sight("camera", noise, "0.8 0 0.4", 2000))), 1);
  EXPECT_GT(apart(noisy, image(Sight("camera", noise, "0.8 0 0.4", 1000, 2))), 1);
}

}  // namespace
}  // namespace verp::camera::test
