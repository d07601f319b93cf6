#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/apps/demos/brain/grid.hpp"
#include "host/apps/demos/brain/packet.hpp"
#include "host/apps/demos/brain/place.hpp"
#include "host/apps/demos/brain/route.hpp"
#include "host/apps/demos/brain/scan.hpp"

namespace verp::brain {
namespace {

constexpr int kRays = 181;

About half_around() {
  About about;
  about.laser_first_rad = -std::numbers::pi / 2;
  about.laser_step_rad = std::numbers::pi / (kRays - 1);
  about.laser_max_m = 4;
  return about;
}

struct Wall {
  Point from, to;
};
Scan scan_of(const About& about, const Pose& robot, const std::vector<Wall>& walls) {
  Scan scan;
  scan.high_m = 0.3;
  for (int i = 0; i < kRays; ++i) {
    const double angle_rad = about.laser_first_rad + i * about.laser_step_rad;
    const Pose ray{robot.at_m, robot.yaw_rad + angle_rad};
    float range_m = std::numeric_limits<float>::infinity();
    for (const Wall& wall : walls) {
      const Point a = into(ray, wall.from), b = into(ray, wall.to);
      if ((a.y > 0) == (b.y > 0)) continue;
      const double x_m = a.x + (b.x - a.x) * a.y / (a.y - b.y);
      if (x_m > 0 && x_m < about.laser_max_m) range_m = std::fmin(range_m, static_cast<float>(x_m));
    }
    scan.range_m.push_back(range_m);
  }
  return scan;
}

std::vector<Wall> box(Point low, Point high) {
  return {{low, {high.x, low.y}},
          {{high.x, low.y}, high},
          {high, {low.x, high.y}},
          {{low.x, high.y}, low}};
}

TEST(Pose, IntoAndOutOfAreInverse) {
  const Pose frame{{1, -2}, 0.7}, inside{{0.3, 0.4}, -2};
  const Pose back = into(frame, out_of(frame, inside));
  EXPECT_NEAR(back.at_m.x, inside.at_m.x, 1e-12);
  EXPECT_NEAR(back.at_m.y, inside.at_m.y, 1e-12);
  EXPECT_NEAR(back.yaw_rad, inside.yaw_rad, 1e-12);
  EXPECT_NEAR(wrapped(3 * std::numbers::pi + 0.1), -std::numbers::pi + 0.1, 1e-12);
}

TEST(Packet, NumbersComeBackAndWhatIsShortIsNotGood) {
  const std::string data =
      Packet('X').put(-1.234, 1e-3).put(Pose{{0.5, -0.25}, 3}).put(99, 1e-3).data();
  EXPECT_EQ(data.size(), 1u + 2 * 5);
  Unpacked in(data);
  EXPECT_EQ(in.kind(), 'X');
  EXPECT_NEAR(in.get(1e-3), -1.234, 1e-9);
  EXPECT_NEAR(in.pose().at_m.y, -0.25, 1e-9);
  EXPECT_NEAR(in.get(1e-3), 32.767, 1e-9);  // out of range
  EXPECT_TRUE(in.good());
  const std::string part = data.substr(0, 5);
  Unpacked more(part);
  more.get(1e-3);
  more.pose();
  EXPECT_FALSE(more.good());
  Unpacked less(data);
  less.get(1e-3);
  EXPECT_FALSE(less.good());
  EXPECT_EQ(Unpacked("").kind(), '\0');
}

TEST(Scan, AThingAheadIsFoundAndAWallIsNone) {
  const About about = half_around();
  std::vector<Wall> walls = box({1.0, -0.06}, {1.1, 0.06});
  walls.push_back({{2, -3}, {2, 3}});
  const std::vector<Thing> found = things(about, scan_of(about, {}, walls));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].at_m.x, 1.0, 0.01);
  EXPECT_NEAR(found[0].at_m.y, 0, 0.02);
  EXPECT_NEAR(middle_of(about, found[0]).x, 1.0 + kBehindSurface_m, 0.01);
}

TEST(Scan, RaysThatMayHaveMetTheFloorAreLeftOut) {
  const About about = half_around();
  Scan scan = scan_of(about, {}, {{{2, -3}, {2, 3}}});
  EXPECT_GT(hits(about, scan).size(), 50u);
  scan.pitch_rad = 0.2;  // the floor is 1.5 m ahead
  const std::vector<Hit> left = hits(about, scan);
  for (const Hit& hit : left) EXPECT_GT(std::abs(direction_rad(hit.at_m)), 0.3);
}

TEST(Route, GoesAsItsBendsSay) {
  const Route route({}, {{1, 0}, {std::numbers::pi / 2, 1}, {1, 0}});
  EXPECT_NEAR(route.long_m(), 2 + std::numbers::pi / 2, 1e-12);
  const Pose end = route.at(route.long_m());
  EXPECT_NEAR(end.at_m.x, 2, 1e-9);
  EXPECT_NEAR(end.at_m.y, 2, 1e-9);
  EXPECT_NEAR(end.yaw_rad, std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(route.at(-0.5).at_m.x, -0.5, 1e-12);
  EXPECT_EQ(route.bent(1.5), 1);
}

TEST(Estimate, SightsMendWhatOdometryLost) {
  const Pose real{{1.1, 0.15}, 0.1};
  Estimate estimate({{0, 0}, 0}, 0.02, 0.02);
  estimate.move({});
  for (int i = 1; i <= 100; ++i) estimate.move({{0.01 * i, 0}, 0});  // slips and turns
  EXPECT_GT(distance(estimate.pose().at_m, real.at_m), 0.15);
  const double before_m = estimate.within_m();
  const Point posts[] = {{2, 1}, {2, -1}};
  for (int i = 0; i < 20; ++i) {
    for (const Point post : posts) EXPECT_TRUE(estimate.see(into(real, post), post, 0.05));
  }
  EXPECT_LT(distance(estimate.pose().at_m, real.at_m), 0.04);
  EXPECT_NEAR(estimate.pose().yaw_rad, real.yaw_rad, 0.04);
  EXPECT_LT(estimate.within_m(), before_m);
  EXPECT_FALSE(estimate.see({0.5, 0.5}, {2, 1}, 0.05));  // another object
}

TEST(Grid, AMapIsMadeAndTheRobotFoundInIt) {
  const About about = half_around();
  const std::vector<Wall> walls = box({-1, -1.5}, {2.5, 1.5});
  Grid grid;
  for (int i = 0; i < 6; ++i) grid.add({}, about, hits(about, scan_of(about, {}, walls)));
  EXPECT_TRUE(grid.taken(Grid::cell(2.5), Grid::cell(0)) ||
              grid.taken(Grid::cell(2.49), Grid::cell(0)));
  EXPECT_FALSE(grid.taken(Grid::cell(1), Grid::cell(0)));
  const Pose real{{0.06, -0.04}, 0.03};
  const Pose found = matched(grid, {}, hits(about, scan_of(about, real, walls)));
  EXPECT_LT(distance(found.at_m, real.at_m), 0.04);
  EXPECT_NEAR(found.yaw_rad, real.yaw_rad, 0.012);
}

TEST(Way, GoesRoundAWallAndKeepsClearOfIt) {
  const About about = half_around();
  const std::vector<Wall> walls = box({0.95, -3}, {1.05, 0.6});
  Grid grid;
  for (int i = 0; i < 6; ++i) grid.add({}, about, hits(about, scan_of(about, {}, walls)));
  const std::vector<Point> found = way(grid, {0, 0}, {2, 0});
  ASSERT_GT(found.size(), 10u);
  double long_m = 0, highest_m = 0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    long_m += distance(found[i - 1], found[i]);
    highest_m = std::fmax(highest_m, found[i].y);
  }
  EXPECT_GT(highest_m, 0.75);  // half a robot's width past the wall's end
  EXPECT_LT(long_m, 3.2);
  EXPECT_TRUE(way(grid, {0, 0}, {100, 0}).empty());
}

TEST(Way, IsNoneOutOfAClosedRoom) {
  const About about = half_around();
  const std::vector<Wall> walls = box({-0.8, -0.8}, {0.8, 0.8});
  Grid grid;
  for (int i = 0; i < 6; ++i) {
    for (const double yaw_rad : {0.0, std::numbers::pi})
      grid.add({{}, yaw_rad}, about, hits(about, scan_of(about, {{}, yaw_rad}, walls)));
  }
  EXPECT_TRUE(way(grid, {0, 0}, {2, 0}).empty());
}

}  // namespace
}  // namespace verp::brain
