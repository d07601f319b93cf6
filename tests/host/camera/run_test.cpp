#include <gtest/gtest.h>
#include <sys/resource.h>

#include <map>
#include <nlohmann/json.hpp>

#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/show/camera/rig.hpp"
#include "host/show/camera/twin_camera.hpp"
#include "host/show/render/files.hpp"
#include "host/show/scene/build.hpp"
#include "host/trace/record/trace.hpp"
#include "tests/host/tool/program.hpp"
#include "tests/support/mcap_file.hpp"

namespace verp::tool::test {
namespace {

using CameraRun = Program;

TEST_F(CameraRun, KeepsEachPictureAndChangesNoBitOfTheRun) {
  const Outcome with =
      as_typed("walk generic21 --for 3 --cameras --record with.mcap --json", "with");
  const Outcome without =
      as_typed("walk generic21 --for 3 --record without.mcap --json", "without");
  ASSERT_EQ(with.status, 0) << with.err;
  ASSERT_EQ(without.status, 0) << without.err;
  const auto seen = nlohmann::json::parse(with.out), blind = nlohmann::json::parse(without.out);
  EXPECT_EQ(seen.at("digest"), blind.at("digest"));

  const auto body = [](const record::Trace& trace) { return trace.bodies.back().pose.position_m; };
  const record::Trace a = record::read_trace(folder_ / "with.mcap", record::Read::kStrict);
  const record::Trace b = record::read_trace(folder_ / "without.mcap", record::Read::kStrict);
  EXPECT_EQ(body(a), body(b));

  std::uint64_t last_ns = 0;
  const std::size_t count =
      record::for_each_picture(folder_ / "with.mcap", [&](const record::RecordedPicture& each) {
        EXPECT_EQ(each.topic, "/camera/image/compressed");
        if (last_ns != 0) {
          EXPECT_NEAR(static_cast<double>(each.time_ns - last_ns), 33.3e6, 1.1e6);
        }
        last_ns = each.time_ns;
      });
  EXPECT_EQ(count, seen.at("cameras").at("pictures").get<std::size_t>());
  EXPECT_NEAR(static_cast<double>(count), 30 * static_cast<double>(a.ticks.size()) * a.period_s(),
              2);

  const std::string bytes = slurp(folder_ / "with.mcap");
  const record::mcap::WholeFile file = record::mcap::parse(bytes);
  EXPECT_FALSE(file.flaw);
  std::map<std::string, std::size_t> messages;
  for (const auto& each : file.messages)
    ++messages[std::string(file.channels.at(each.channel).topic)];
  EXPECT_EQ(messages["/camera/camera_info"], count);
  EXPECT_EQ(messages["/tf_static"], 1u);

  ASSERT_EQ(verp("trace pictures with.mcap -o pictures").status, 0);
  std::size_t files = 0;
  for (const auto& each : fs::directory_iterator(folder_ / "pictures")) {
    EXPECT_EQ(render::read_png(each.path().string()).size.width, 320);
    ++files;
  }
  EXPECT_EQ(files, count);
}

TEST_F(CameraRun, WrongWordsCostOneLine) {
  const Outcome no_trace = verp("walk generic21 --cameras --json");
  EXPECT_EQ(no_trace.status, 2);
  EXPECT_NE(no_trace.err.find("give --record"), std::string::npos) << no_trace.err;
  expect_refused("walk generic21 --cameras --seeds 1-2", "--seeds");
  ASSERT_EQ(verp("walk generic21 --for 3 --record a.mcap --json").status, 0);
  expect_refused("trace pictures a.mcap -o b", "--cameras");
  const Outcome no_driver = shell(
      "EGL_PLATFORM=none LIBGL_DRIVERS_PATH=/nowhere __EGL_VENDOR_LIBRARY_FILENAMES=/dev/null " +
      std::string(VERP_PROGRAM) + " walk generic21 --cameras --json --record c.mcap");
  EXPECT_EQ(no_driver.status, 3) << no_driver.err;
  EXPECT_NE(no_driver.err.find("GL driver"), std::string::npos) << no_driver.err;
  EXPECT_FALSE(fs::exists(folder_ / "c.mcap"));
}

}  // namespace
}  // namespace verp::tool::test

namespace verp::camera::test {
namespace {

struct Stand {
  Stage stage{.robots = {{model::find_model("generic21"), 1}}, .world_file = ""};
  Moment moment;

  Stand() {
    const model::Entity robot = model::load_robot(stage.robots[0].file);
    moment.cameras = {0};
    moment.link_world = {scene::standing(robot).link_world};
  }
};

TEST(TwinCamera, GivesPicturesThatAreDrawnOfTheTwin) {
  Stand stand;
  Rig rig(VERP_CAMERA, stand.stage, Rig::Pace::kEveryPicture);
  sim::World world;
  sim::TwinRobot twin(world, model::load_robot(stand.stage.robots[0].file),
                      {.cradle = sim::Cradle::kAlways, .cameras = true});
  TwinCamera<> camera(rig, twin, 0);
  hal::CameraFrame frame;
  EXPECT_EQ(camera.read(frame), hal::CameraStatus::kStale);
  std::uint32_t pictures = 0;
  for (std::uint64_t i = 1; i <= 12; ++i) {
    world.advance_to(34'000 * i);
    if (camera.read(frame) != hal::CameraStatus::kFresh) continue;
    EXPECT_EQ(frame.sequence, pictures++);
    EXPECT_EQ(frame.lost, 0u);
    EXPECT_EQ(frame.format, hal::PixelFormat::kPng);
    const render::Image image =
        render::read_png("a frame", {reinterpret_cast<const char*>(frame.data), frame.size_bytes});
    EXPECT_EQ(image.size.width, 320);
    EXPECT_EQ(frame.width_px, 320u);
  }
  EXPECT_EQ(pictures, 12 - Rig::kAhead) << "a rig that keeps all is so many behind";
  EXPECT_EQ(camera.faults(), 0u);
}

TEST(Rig, InRealTimeDropsWhatItCannotDrawAndNeverWaits) {
  Stand stand;
  Rig rig(VERP_CAMERA, stand.stage, Rig::Pace::kNeverWaits);
  for (int i = 0; i < 40; ++i) rig.expose(stand.moment);
  EXPECT_EQ(rig.moments(), Rig::kAhead);
  EXPECT_EQ(rig.dropped(), 40 - Rig::kAhead);
  std::size_t pictures = 0;
  for (auto done = rig.take_last(); !done.empty(); done = rig.take_last()) pictures += done.size();
  EXPECT_EQ(pictures, Rig::kAhead);
  EXPECT_GT(rig.processor_s(), 0);
}

TEST(DrawingProgram, StepsBackWithAllItsThreads) {
  DrawingProgram program(VERP_CAMERA, Stand().stage);
  const auto group = static_cast<id_t>(program.process());
  EXPECT_LT(::getpriority(PRIO_PGRP, group), 19) << "of the group the one that comes first";
  program.step_back();
  EXPECT_EQ(::getpriority(PRIO_PGRP, group), 19);
}

TEST(Rig, ElseGivesThePicturesOfAMomentAFixedNumberOfMomentsLater) {
  Stand stand;
  Rig rig(VERP_CAMERA, stand.stage, Rig::Pace::kEveryPicture);
  for (std::uint64_t i = 0; i < 12; ++i) {
    stand.moment.time_us = i;
    rig.expose(stand.moment);
    const std::vector<Picture> pictures = rig.take();
    ASSERT_EQ(pictures.size(), i < Rig::kAhead ? 0u : 1u) << i;
    if (!pictures.empty()) {
      EXPECT_EQ(pictures[0].time_us, i - Rig::kAhead);
    }
  }
  EXPECT_EQ(rig.dropped(), 0u);
}

TEST(Rig, SaysWhatIsMissing) {
  const Stand stand;
  const auto why = [](const char* program, const Stage& stage) {
    try {
      const Rig rig(program, stage, Rig::Pace::kEveryPicture);
      return std::string("nothing");
    } catch (const CameraError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_NE(why("/nowhere/verp_camera", stand.stage).find("No such file"), std::string::npos);
  Stage gone = stand.stage;
  gone.world_file = "/nowhere/world.sdf";
  EXPECT_NE(why(VERP_CAMERA, gone).find("/nowhere/world.sdf"), std::string::npos);
  EXPECT_NE(why("/bin/false", stand.stage).find("ended"), std::string::npos);
}

}  // namespace
}  // namespace verp::camera::test
