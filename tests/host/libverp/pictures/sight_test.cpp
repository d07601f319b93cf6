#include <chrono>
#include <cstring>
#include <map>

#include "host/robot/model/find.hpp"
#include "host/robot/model/lens.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/show/camera/rig.hpp"
#include "host/twin/sim/scenery.hpp"
#include "tests/host/camera/files.hpp"
#include "tests/host/libverp/pictures/pictures.hpp"

// A program sees what a trace keeps, and the run does not change.

namespace verp::abi::test {
namespace {

camera::Picture as_a_trace_keeps_it(const std::string& world_file) {
  session::WalkPlan plan = session::test::plan_of("");
  plan.twin.cameras = true;
  sim::Exposure last;
  session::Hooks hooks;
  hooks.exposed = [&last](const sim::Exposure& exposure, std::uint64_t) { last = exposure; };
  session::Options options;
  options.world = sim::furnished(options.world, model::load_world(world_file));
  session::walk(plan, hooks, options);
  camera::Rig rig(camera::find_program(),
                  {.robots = {{plan.entity.file, 1}}, .world_file = world_file},
                  camera::Rig::Pace::kEveryPicture);
  rig.expose({.time_us = last.time_us,
              .cameras = {0},
              .link_world = last.link_world,
              .body_world = last.body_world,
              .raw = true});
  return rig.take_last().at(0);
}

TEST(LibverpSight, ReadsWhatATraceKeepsAndNoBitOfTheRunChanges) {
  Looking blind, looking;
  blind.add();
  looking.add();
  blind.run();
  verp_view small = Looking::view("follow");
  small.width = small.height = 32;
  std::size_t different = 0;
  std::vector<std::uint8_t> before;
  int status = VERP_OK;
  while (status == VERP_OK) {
    status = verp_session_tick(looking.session, 40, nullptr, nullptr);
    std::vector<std::uint8_t> now = looking.colour();
    looking.render(small);
    different += now != before;
    before = std::move(now);
  }
  EXPECT_EQ(looking.result().digest, blind.result().digest);
  EXPECT_GT(different, 10U);

  const camera::Picture kept = as_a_trace_keeps_it(model::find_world("demo"));
  double time_s = 0;
  const auto seen = looking.picture<std::uint8_t>(VERP_COLOUR, 0, &time_s);
  EXPECT_NEAR(time_s, 1e-6 * static_cast<double>(kept.time_us), 1e-9);
  ASSERT_EQ(seen.size(), kept.data.size());
  EXPECT_EQ(std::memcmp(seen.data(), kept.data.data(), seen.size()), 0);
}

TEST(LibverpSight, LooksAsOftenAsItsFileSaysAndNotBeforeTheFirstTick) {
  Looking looking;
  looking.add();
  EXPECT_TRUE(looking.colour().empty());
  verp_tick seen = {};
  seen.size = sizeof seen;
  ASSERT_EQ(verp_session_view(looking.session, 0, &seen), VERP_OK);
  const double period_s = 1 / looking.camera().rate_hz;
  double last_s = 0;
  std::size_t looks = 0;
  for (int i = 0; i < 60; ++i) {
    looking.tick(1);
    double time_s = 0;
    if (looking.picture<std::uint8_t>(VERP_COLOUR, 0, &time_s).empty()) continue;
    EXPECT_LE(time_s, seen.time_s);
    EXPECT_GT(time_s, seen.time_s - period_s - 1e-3);
    if (last_s > 0 && time_s > last_s) {
      EXPECT_NEAR(time_s - last_s, period_s, 1.1e-3);
    }
    looks += time_s > last_s;
    last_s = time_s;
  }
  EXPECT_NEAR(static_cast<double>(looks), 60 * 0.010 / period_s, 2);
}

TEST(LibverpSight, EqualSessionsGiveEqualPictures) {
  const auto pictures = [] {
    Looking looking;
    looking.add();
    looking.tick(200);
    return std::pair(looking.colour(), looking.render(Looking::view("three-quarter")));
  };
  const auto first = pictures();
  EXPECT_EQ(first, pictures());
  EXPECT_NE(first.first, first.second);
}

TEST(LibverpSight, ColourDepthAndLabelsAreOfTheThingThatIsThere) {
  const camera::test::Files files;
  const std::string world = files.world("0.8 0 0.4");
  for (const char* type : {"rgbd_camera", "segmentation_camera"}) {
    const std::string robot_file = files.robot(type, "");
    Looking looking(world.c_str());
    looking.add([&](verp_robot& robot) { robot.model = robot_file.c_str(); });
    looking.tick(30);
    const verp_camera by = looking.camera();
    const bool labels = by.gives == VERP_LABELS;
    EXPECT_EQ(by.gives, labels ? 4U : 1U | 2U);
    EXPECT_STREQ(by.name, "camera");
    EXPECT_EQ(by.width * by.height, 320U * 240U);
    const auto of_pixel = looking.picture<std::uint16_t>(labels ? VERP_LABELS : VERP_DEPTH);
    ASSERT_EQ(of_pixel.size(), 320U * 240U);
    std::map<std::uint16_t, std::size_t> counts;
    std::vector<std::uint8_t> colour;
    if (!labels) colour = looking.picture<std::uint8_t>(VERP_COLOUR);
    for (std::size_t i = 0; i < of_pixel.size(); ++i) {
      const std::uint8_t* rgb = labels ? nullptr : colour.data() + 3 * i;
      const bool red = !labels && rgb[0] > 60 && rgb[0] > 3 * rgb[1] && rgb[0] > 3 * rgb[2];
      if (labels || red) ++counts[of_pixel[i]];
    }
    if (labels) {
      EXPECT_GE(counts.size(), 2U) << "the ball, and the floor";
      EXPECT_GT(counts[0], 10000U);
      continue;
    }
    std::size_t ball = 0;
    for (const auto& [mm, count] : counts) {
      EXPECT_GT(mm, 600) << "no nearer than the ball";
      EXPECT_LT(mm, 850) << "no farther";
      ball += count;
    }
    EXPECT_GT(ball, 500U);
  }
}

TEST(LibverpSight, EachOfTwoRobotsSeesForItself) {
  Looking looking(nullptr);
  looking.add();
  looking.add([](verp_robot& robot) {
    robot.x_m = 1.5;
    robot.yaw_rad = 3.14159;
    robot.seed = 2;
  });
  looking.tick(60);
  const auto first = looking.colour(0), second = looking.colour(1);
  Looking alone(nullptr);
  alone.add();
  alone.tick(30);
  const auto empty = alone.colour();
  for (const auto& picture : {first, second}) {
    std::size_t other = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) other += std::abs(picture[i] - empty[i]) > 40;
    EXPECT_GT(other, 300U) << "each has the other one in its picture";
  }
}

TEST(LibverpSight, IsSeenFromWhereOneSays) {
  const camera::test::Files files;
  Looking looking(files.world("0.8 0 0.4").c_str());
  looking.add();
  std::map<std::string, std::vector<std::uint8_t>> pictures;
  for (const char* name : {"front", "side", "three-quarter", "back", "top", "follow", "head"})
    pictures[name] = looking.render(Looking::view(name));
  for (const auto& [name, picture] : pictures) {
    for (const auto& [other, that] : pictures) {
      EXPECT_TRUE(name == other || picture != that) << name << " is " << other;
    }
  }
  for (const double aside_m : {0.0, -1.0}) {
    verp_view view = Looking::view(nullptr);
    const double eye[] = {0.8, aside_m, aside_m == 0 ? 1.4 : 0.4}, ball[] = {0.8, 0, 0.4};
    std::copy_n(eye, 3, view.eye_m);
    std::copy_n(ball, 3, view.target_m);
    view.flags = VERP_PLAIN;
    const auto picture = looking.render(view);
    const auto red = [&](std::size_t x, std::size_t y) {
      const std::uint8_t* rgb = picture.data() + 3 * (320 * y + x);
      return rgb[0] > 60 && rgb[0] > 2 * rgb[1] && rgb[0] > 2 * rgb[2];
    };
    EXPECT_TRUE(red(160, 120)) << aside_m;
    EXPECT_FALSE(red(10, 10)) << aside_m;
    // 0.05 m of 1 m; the picture is 2 tan(0.25) m high.
    EXPECT_TRUE(red(160, 120 + 20) && !red(160, 120 + 27)) << aside_m;
  }
}

/// Prints the costs without a check (host/apps/libverp/README.md).
TEST(LibverpSight, SaysWhatAPictureCosts) {
  using Clock = std::chrono::steady_clock;
  Looking looking;
  looking.add();
  looking.tick(1);
  const auto cost_ms = [&](const auto& draw) {
    double sum_ms = 0;
    constexpr int kTimes = 20;
    for (int i = -1; i < kTimes; ++i) {
      looking.tick(5);  // over a camera period
      const auto start = Clock::now();
      draw();
      if (i >= 0) sum_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
    return sum_ms / kTimes;
  };
  verp_view plain = Looking::view("follow");
  plain.flags = VERP_PLAIN;
  const double camera_ms = cost_ms([&] { looking.colour(); });
  const double follow_ms = cost_ms([&] { looking.render(Looking::view("follow")); });
  const double plain_ms = cost_ms([&] { looking.render(plain); });
  std::printf("a picture of 320x240: of a camera %.1f ms, from outside %.1f ms, plain %.1f ms\n",
              camera_ms, follow_ms, plain_ms);
  EXPECT_GT(camera_ms, 0);
}

}  // namespace
}  // namespace verp::abi::test
