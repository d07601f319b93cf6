#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/apps/demos/brain/follow.hpp"
#include "tests/host/demos/told.hpp"

namespace verp::demos {
namespace {

class World {
 public:
  World(const std::string& name, double post_x_m, double ball_x_m)
      : file_(std::filesystem::path(testing::TempDir()) / (name + ".sdf")) {
    std::ofstream out(file_);
    out << R"(<?xml version="1.0"?><sdf version="1.9"><world name="far">
<model name="ground"><static>true</static><link name="link"><collision name="floor"><geometry>
<plane><normal>0 0 1</normal><size>200 200</size></plane></geometry></collision></link></model>
<model name="post"><static>true</static><pose>)"
        << post_x_m << R"( 1.5 0.3 0 0 0</pose><link name="link"><collision name="post"><geometry>
<box><size>0.2 0.2 0.6</size></box></geometry></collision></link></model>
<model name="ball"><pose>)"
        << ball_x_m << R"( 30 0.4 0 0 0</pose><link name="link"><inertial><mass>1</mass><inertia>
<ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="ball"><geometry>
<sphere><radius>0.1</radius></sphere></geometry></collision></link></model></world></sdf>)";
  }
  ~World() { std::filesystem::remove(file_); }
  std::string file() const { return file_.string(); }

 private:
  std::filesystem::path file_;
};

struct Seen {
  std::vector<std::uint64_t> all;
  std::size_t scans = 0, messages = 0;
};

Seen what_they_are_told(const World& world) {
  const auto& demos = all_demos();
  const auto follow = std::find_if(demos.begin(), demos.end(),
                                   [](const Demo& each) { return each.name == "follow"; });
  Options options;
  options.robots = 2;
  options.for_s = 6.5;  // they walk from 5 s on
  options.world = world.file();
  test::Told told(options);
  run(*follow, options);
  return {told.all(), told.scans(), told.messages()};
}

TEST(NoTruth, WhatABrainCannotSenseChangesNothingThatItIsTold) {
  const Seen here = what_they_are_told(World("here", 60, 40));
  const Seen elsewhere = what_they_are_told(World("elsewhere", 70, 55));
  const Seen in_sight = what_they_are_told(World("in_sight", 1.5, 40));
  ASSERT_GT(here.all.size(), 200u);
  EXPECT_GT(here.scans, 100u);
  EXPECT_GT(here.messages, 20u);
  EXPECT_EQ(here.all, elsewhere.all);
  EXPECT_NE(here.all, in_sight.all);
}

}  // namespace
}  // namespace verp::demos
