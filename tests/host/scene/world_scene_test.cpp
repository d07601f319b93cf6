#include <gtest/gtest.h>

#include <set>

#include "host/os/files/temporary_directory.hpp"
#include "host/robot/model/load_world.hpp"
#include "host/show/scene/build.hpp"
#include "host/show/scene/from_trace.hpp"
#include "host/show/scene/from_twin.hpp"
#include "host/trace/record/trace_writer.hpp"
#include "tests/host/session/plans.hpp"

namespace verp::scene {
namespace {

std::shared_ptr<const model::World> demo() {
  return std::make_shared<const model::World>(model::load_world(model::find_world("demo")));
}

TEST(WorldScene, EachShippedWorldShowsAllItsThingsAndMovesThoseThatMove) {
  for (const std::string& name : model::world_names()) {
    const model::World world = model::load_world(model::find_world(name));
    const Scene scene = surroundings(&world);
    const auto moving = model::moving(world);
    std::set<std::string> seen;
    for (const Item& item : scene.items) {
      if (item.collision) continue;
      seen.insert(item.name);
      EXPECT_TRUE(item.pose.matrix().allFinite()) << item.name;
      EXPECT_EQ(label_name(scene, label_of(scene, item)), item.name);
      if (item.node == kWorld) continue;
      ASSERT_LT(static_cast<std::size_t>(item.node), moving.size());
      EXPECT_EQ(moving[static_cast<std::size_t>(item.node)]->name, item.name);
    }
    for (const model::WorldObject& object : world.objects) {
      const bool floor_only =
          object.visuals.size() == 1 && object.visuals[0].shape.kind == model::Shape::Kind::kPlane;
      EXPECT_TRUE(floor_only ? scene.ground.on : seen.contains(object.name))
          << name << ": " << object.name;
    }
    EXPECT_EQ(scene.lights.size(), world.lights.size());
  }
}

TEST(WorldScene, AHeightfieldIsDrawnAtItsHeights) {
  model::World world;
  model::WorldObject& object = world.objects.emplace_back();
  auto field = std::make_shared<model::Heightfield>();
  *field = {.columns = 3, .rows = 2, .size_x_m = 4, .size_y_m = 2, .height_m = {0, 1, 0, 0, 1, 0}};
  model::WorldVisual& visual = object.visuals.emplace_back();
  visual.shape.kind = model::Shape::Kind::kHeightfield;
  visual.shape.heightfield = field;
  const Scene scene = surroundings(&world);
  ASSERT_EQ(scene.items.size(), 1u);
  const Triangles& mesh = *scene.items[0].triangles;
  ASSERT_EQ(mesh.points.size(), 6u);
  EXPECT_EQ(mesh.indices.size(), 12u);
  EXPECT_EQ(mesh.points[1], Eigen::Vector3f(0, -1, 1));
  EXPECT_EQ(mesh.points[5], Eigen::Vector3f(2, 1, 0));
  EXPECT_EQ(mesh.normals[1], Eigen::Vector3f(0, 0, 1));
  EXPECT_NEAR(mesh.normals[0].x(), -0.4472F, 1e-4F) << "a slope of 1 in 2";
}

TEST(WorldScene, ATraceShowsThingsWhereTheTwinHadThemAndItsContactsBearTheRobot) {
  const session::WalkPlan plan = session::test::plan_of("dxl");
  const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "a.mcap";
  record::TraceWriter writer(file, plan.params,
                             {{"model_file", plan.entity.file}, {"world_file", "demo"}});
  std::vector<Snapshot> shots;
  session::Hooks hooks;
  hooks.trace = &writer;
  hooks.ticked = [&](const session::Tick& tick) {
    shots.push_back(snapshot(tick, plan.entity, plan.params));
  };
  session::Options options;
  options.world.ground = false;
  options.world.scenery = demo();
  ASSERT_EQ(session::walk(plan, hooks, options).failure, "");
  writer.close();

  const TracePlayer player(file);
  EXPECT_EQ(player.note(), "");
  ASSERT_NE(player.world(), nullptr);
  ASSERT_EQ(player.size(), shots.size());
  const std::size_t moving = model::moving(*player.world()).size();
  double borne_n = 0, gone_m = 0;
  for (std::size_t i = 0; i < shots.size(); i += 7) {
    const Snapshot here = player.at(i);
    ASSERT_EQ(here.body_world.size(), moving);
    ASSERT_EQ(shots[i].body_world.size(), moving);
    for (std::size_t k = 0; k < moving; ++k) {
      const Vec3 there_m = shots[i].body_world[k].translation();
      EXPECT_LT((here.body_world[k].translation() - there_m).norm(), 2e-3) << i;
      gone_m = std::max(gone_m, (there_m - shots[0].body_world[k].translation()).norm());
    }
    for (const ContactForce& contact : shots[i].robots[0].contacts)
      borne_n += contact.force_world_n.z();
  }
  EXPECT_GT(gone_m, 0.3) << "the cart drives";
  double mass_kg = 0;
  for (const model::Node& node : plan.entity.nodes) mass_kg += node.mass_kg;
  const double mean_n = borne_n / (static_cast<double>(shots.size() + 6) / 7);
  EXPECT_NEAR(mean_n, 9.81 * mass_kg, 0.25 * 9.81 * mass_kg);
}

}  // namespace
}  // namespace verp::scene
